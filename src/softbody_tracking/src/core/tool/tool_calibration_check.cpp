#include "softbody_tracking/tool/tool_calibration_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace softbody {
namespace {

constexpr double kMostlySeen = 0.9;
constexpr double kGoodReprojection_px = 1.0;
constexpr double kGoodDepthRatio = 0.015;
constexpr double kGoodNoise_m = 0.002;

ToolTrackerConfig cornersOnly() {
  ToolTrackerConfig config;
  config.use_depth = false;
  // What does not fit well is to be measured here, not left out.
  config.max_reprojection_px = 10.0;
  return config;
}

double mean(const std::vector<double>& values) {
  return values.empty()
             ? 0.0
             : std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

double median(std::vector<double> values) {
  if (values.empty()) return 0.0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// Second differences know nothing of an even motion; of white noise they have six times the variance.
double noise(const std::vector<Eigen::Vector3d>& positions) {
  double sum = 0.0;
  for (std::size_t i = 2; i < positions.size(); ++i)
    sum += (positions[i] - 2.0 * positions[i - 1] + positions[i - 2]).squaredNorm();
  return positions.size() < 3 ? 0.0 : std::sqrt(sum / (6.0 * static_cast<double>(positions.size() - 2)));
}

}  // namespace

ToolCalibrationCheck::ToolCalibrationCheck(const ToolDescription& tool) : tracker_(tool), corners_only_(tool, cornersOnly()) {}

void ToolCalibrationCheck::add(const RgbdFrame& frame) {
  ++frames_;
  focal_px_ = frame.camera.fx;
  const auto observation = tracker_.track(frame, nullptr);
  if (observation && !observation->bridged) {
    positions_.push_back(observation->T_camera_tool.translation());
  } else {
    ++reasons_[tracker_.reason()];
  }
  const auto corners = corners_only_.track(frame, nullptr);
  if (!corners || corners->bridged) return;
  reprojections_px_.push_back(corners->reprojection_px);
  const double z = corners->T_camera_tool.translation().z();
  if (corners->depth_offset_m != 0.0) depth_ratios_.push_back((z + corners->depth_offset_m) / z);
}

ToolCalibrationReport ToolCalibrationCheck::report() const {
  ToolCalibrationReport report{frames_,
                         static_cast<int>(positions_.size()),
                         mean(reprojections_px_),
                         median(depth_ratios_),
                         noise(positions_),
                         {}};
  const auto say = [&report](const std::string& fault) { report.faults.push_back(fault); };
  if (report.seen < kMostlySeen * report.frames) {
    const auto most = std::max_element(reasons_.begin(), reasons_.end(),
                                       [](const auto& a, const auto& b) { return a.second < b.second; });
    say(fmt::format("the tool is seen in {} of {} frames; else mostly: {}", report.seen, report.frames,
                    most->first));
  }
  if (report.reprojection_px > kGoodReprojection_px) {
    say(fmt::format(
        "corners lie {:.1f} px from where the pose puts them: the intrinsics or the distortion are "
        "wrong, the print is bent, or the markers' poses in the YAML are not those on the tool",
        report.reprojection_px));
  }
  if (report.depth_ratio > 0.0 && std::abs(report.depth_ratio - 1.0) > kGoodDepthRatio) {
    const double size_mm = 1e3 * tracker_.tool().markers.front().size_m;
    say(fmt::format(
        "depth puts the markers {:.3f} times as far as their size does: either they measure {:.1f} mm, "
        "not {:.1f}, or fx is {:.0f}, not {:.0f}, or the depth scale is wrong",
        report.depth_ratio, report.depth_ratio * size_mm, size_mm, report.depth_ratio * focal_px_,
        focal_px_));
  }
  if (report.depth_ratio == 0.0 && !reprojections_px_.empty())
    say("there is no depth under the markers: size and intrinsics cannot be checked against it");
  if (report.noise_m > kGoodNoise_m) {
    say(fmt::format(
        "the pose jitters by {:.1f} mm from frame to frame: larger markers, more light or a shorter "
        "exposure help",
        1e3 * report.noise_m));
  }
  return report;
}

}  // namespace softbody
