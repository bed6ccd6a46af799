#include "motion/sheet_motion.h"

namespace softbody::scanning {
namespace {

constexpr double kBesideSheet = 0.25;  // of its size, on each side

/// Depth on the markers is measured by the same camera as the object: its bias would tilt the object, too.
ToolTrackerConfig cornersOnly() {
  ToolTrackerConfig config;
  config.use_depth = false;
  return config;
}

}  // namespace

SheetMotion::SheetMotion(const ToolDescription& sheet) : tracker_(sheet, cornersOnly()) {}

std::optional<CameraPose> SheetMotion::poseOf(const RgbdFrame& frame) {
  const auto seen = tracker_.track(frame, nullptr);
  reason_ =
      seen && seen->ambiguous ? "two poses of the sheet fit equally well" : "no marker of the sheet is seen";
  if (!seen || seen->bridged || seen->ambiguous) return std::nullopt;
  reason_.clear();
  return CameraPose{seen->T_camera_tool, seen->covariance};
}

ModelFrame SheetMotion::modelFrame(std::vector<KeyFrame>*) {
  ModelFrame frame;
  for (const ToolMarker& marker : tracker_.tool().markers) {
    const auto corners = markerCorners(marker);
    for (int k = 0; k < 4; ++k) frame.region.extend(Eigen::Vector3d(corners.col(k)));
  }
  const Eigen::Vector3d beside = kBesideSheet * frame.region.sizes();  // an object may hang over the sheet
  frame.region = {Eigen::Vector3d(frame.region.min() - beside), Eigen::Vector3d(frame.region.max() + beside)};
  frame.region.max().z() = frame.region.sizes().head<2>().norm();
  frame.region.min().z() = -0.01;
  return frame;
}

}  // namespace softbody::scanning
