#include "softbody_tracking/tool/tool_calibration_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "softbody_common/statistics/median.h"
#include "softbody_tracking/tool/marker_absence.h"

namespace softbody {
namespace {

constexpr double kMinSeenFraction = 0.9;       // of the frames; fewer are reported
constexpr double kMaxReprojection_px = 1.0;    // [px] mean rms error of a good calibration
constexpr double kMaxDepthRatioError = 0.015;  // relative error of depth that a good camera may have
constexpr double kMaxNoise_m = 0.002;          // [m] jitter that still allows clean cuts
constexpr double kLooseGate_px = 10.0;         // [px] a wrong calibration must be measured, not rejected

ToolTrackerConfig cornersOnly() {
  ToolTrackerConfig config;
  config.use_depth = false;
  config.max_reprojection_px = kLooseGate_px;
  return config;
}

double mean(const std::vector<double>& values) {
  return values.empty()
             ? 0.0
             : std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

/// Standard deviation from second differences, which an even motion does not change. For white noise they
/// have six times its variance.
double noise(const std::vector<Eigen::Vector3d>& positions) {
  double sum = 0.0;
  for (std::size_t i = 2; i < positions.size(); ++i)
    sum += (positions[i] - 2.0 * positions[i - 1] + positions[i - 2]).squaredNorm();
  return positions.size() < 3 ? 0.0 : std::sqrt(sum / (6.0 * static_cast<double>(positions.size() - 2)));
}

}  // namespace

ToolCalibrationCheck::ToolCalibrationCheck(const ToolDescription& tool)
    : tracker_(tool), corners_only_(tool, cornersOnly()) {}

void ToolCalibrationCheck::add(const RgbdFrame& frame) {
  ++frames_;
  focal_px_ = frame.camera.fx;
  const auto observation = tracker_.track(frame, nullptr);
  if (observation && !observation->bridged && !observation->ambiguous) {
    positions_.push_back(observation->T_camera_tool.translation());
  } else {
    const int missed = ++reasons_[tracker_.reason()];
    // A closer look takes as long as many frames: at the 1st, 2nd, 4th, 8th, ... of them.
    if (tracker_.reason() == kNoMarkerSeen && (missed & (missed - 1)) == 0) {
      const std::string cause = whyMarkersAreMissed(tracker_.tool(), frame.color);
      if (!cause.empty()) cause_ = cause;
    }
  }
  const auto corners = corners_only_.track(frame, nullptr);
  if (!corners || corners->bridged || corners->ambiguous) return;
  reprojections_px_.push_back(corners->reprojection_px);
  const double z = corners->T_camera_tool.translation().z();
  if (corners->depth_offset_m != 0.0) depth_ratios_.push_back((z + corners->depth_offset_m) / z);
}

ToolCalibrationReport ToolCalibrationCheck::report() const {
  ToolCalibrationReport report;
  report.frames = frames_;
  report.seen = static_cast<int>(positions_.size());
  report.reprojection_px = mean(reprojections_px_);
  report.depth_ratio = medianOf(depth_ratios_);
  report.noise_m = noise(positions_);
  addVisibilityFault(&report);
  if (report.reprojection_px > kMaxReprojection_px) {
    report.faults.push_back(fmt::format(
        "corners lie {:.1f} px from where the pose puts them. Either the intrinsics or the distortion "
        "are wrong, or the print is bent, or the markers' poses in the YAML are wrong",
        report.reprojection_px));
  }
  addDepthFault(&report);
  if (report.noise_m > kMaxNoise_m) {
    report.faults.push_back(fmt::format(
        "the pose jitters by {:.1f} mm from frame to frame: use larger markers, more light or a shorter "
        "exposure",
        1e3 * report.noise_m));
  }
  return report;
}

void ToolCalibrationCheck::addVisibilityFault(ToolCalibrationReport* report) const {
  if (report->seen >= kMinSeenFraction * report->frames) return;
  const auto most_frequent = std::max_element(
      reasons_.begin(), reasons_.end(), [](const auto& a, const auto& b) { return a.second < b.second; });
  report->faults.push_back(
      fmt::format("the tool is seen in {} of {} frames. The most frequent reason: {}{}{}", report->seen,
                  report->frames, most_frequent->first, cause_.empty() ? "" : ". Probably ", cause_));
}

void ToolCalibrationCheck::addDepthFault(ToolCalibrationReport* report) const {
  const double ratio = report->depth_ratio;
  if (ratio == 0.0) {
    if (!reprojections_px_.empty())
      report->faults.emplace_back(
          "there is no depth on the markers, so size and intrinsics cannot be checked");
    return;
  }
  if (std::abs(ratio - 1.0) <= kMaxDepthRatioError) return;
  const double size_mm = 1e3 * tracker_.tool().markers.front().size_m;
  report->faults.push_back(fmt::format(
      "by depth the markers are {:.3f} times as far away as by their size. Either they measure {:.1f} "
      "mm, not {:.1f}, or fx is {:.0f}, not {:.0f}, or the depth scale is wrong",
      ratio, ratio * size_mm, size_mm, ratio * focal_px_, focal_px_));
}

}  // namespace softbody
