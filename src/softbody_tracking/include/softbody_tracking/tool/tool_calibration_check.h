#pragma once

#include <map>
#include <string>
#include <vector>

#include "softbody_tracking/tool/tool_tracker.h"

namespace softbody {

/// How well a recording agrees with a tool YAML and the camera's calibration.
struct ToolCalibrationReport {
  int frames = 0, seen = 0;
  double reprojection_px = 0.0;  ///< mean over frames of the rms error, for poses from corners alone
  double depth_ratio = 0.0;      ///< median of measured / computed depth, for poses from corners; 0: no depth
  double noise_m = 0.0;          ///< standard deviation of the position between frames, without the motion
  std::vector<std::string> faults;  ///< one sentence each; empty: nothing is wrong
};

/// Checks a tool YAML and the camera's calibration: compares poses from marker corners with depth, frame by
/// frame.
class ToolCalibrationCheck {
 public:
  /// @throw std::invalid_argument as ToolTracker does.
  explicit ToolCalibrationCheck(const ToolDescription& tool);
  void add(const RgbdFrame& frame);
  ToolCalibrationReport report() const;

 private:
  void addVisibilityFault(ToolCalibrationReport* report) const;
  void addDepthFault(ToolCalibrationReport* report) const;

  ToolTracker tracker_, corners_only_;
  int frames_ = 0;
  double focal_px_ = 0.0;
  std::vector<Eigen::Vector3d> positions_;  ///< of the tool, in frames where it was seen
  std::vector<double> reprojections_px_, depth_ratios_;
  std::map<std::string, int> reasons_;  ///< why the tool was not seen, with the number of frames
  std::string cause_;                   ///< what the image showed instead of its markers; empty: nothing
};

}  // namespace softbody
