#include "motion/sheet_depth.h"

#include <algorithm>

namespace softbody::scanning {
namespace {

constexpr int kStep_px = 8;

void addRatios(const KeyFrame& frame, const Eigen::AlignedBox3d& region, std::vector<double>* ratios) {
  const Eigen::Isometry3d T_model_camera = frame.T_camera_model.inverse();
  const Eigen::Vector3d eye = T_model_camera.translation();
  for (int row = 0; row < frame.depth.rows; row += kStep_px) {
    for (int column = 0; column < frame.depth.cols; column += kStep_px) {
      const float z = frame.depth(row, column);
      if (!(z > 0.0f)) continue;
      const Eigen::Vector3d ray = T_model_camera.linear() * frame.camera.unproject(column, row, 1.0);
      const double expected = -eye.z() / ray.z();
      const Eigen::Vector3d place = eye + expected * ray;
      if (!(expected > 0.0) || !region.contains(Eigen::Vector3d(place.x(), place.y(), region.center().z())))
        continue;
      ratios->push_back(z / expected);
    }
  }
}

}  // namespace

double depthScale(const std::vector<KeyFrame>& frames, const Eigen::AlignedBox3d& region) {
  std::vector<double> ratios;
  for (const KeyFrame& frame : frames) addRatios(frame, region, &ratios);
  if (ratios.empty()) return 0.0;
  // The object hides a part of the table, and only ever makes the ratio smaller: the upper half is the
  // table's.
  const auto place = ratios.begin() + static_cast<std::ptrdiff_t>(3 * ratios.size() / 4);
  std::nth_element(ratios.begin(), place, ratios.end());
  return *place;
}

}  // namespace softbody::scanning
