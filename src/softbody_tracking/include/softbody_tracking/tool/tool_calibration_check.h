#pragma once

#include <map>
#include <string>
#include <vector>

#include "softbody_tracking/tool/tool_tracker.h"

namespace softbody {

/// What a recording says of a tool YAML and of the camera.
struct ToolCalibrationReport {
  int frames = 0, seen = 0;
  double reprojection_px = 0.0;     ///< mean of the frames' rms, from corners alone
  double depth_ratio = 0.0;         ///< median of measured over computed depth, corners alone; 0: no depth
  double noise_m = 0.0;             ///< standard deviation from frame to frame, motion taken off
  std::vector<std::string> faults;  ///< sentences; empty: nothing is wrong
};

/// Compares what markers' corners say with what depth says, frame by frame.
class ToolCalibrationCheck {
 public:
  /// @throw std::invalid_argument as ToolTracker.
  explicit ToolCalibrationCheck(const ToolDescription& tool);
  void add(const RgbdFrame& frame);
  ToolCalibrationReport report() const;

 private:
  ToolTracker tracker_, corners_only_;
  int frames_ = 0;
  double focal_px_ = 0.0;
  std::vector<Eigen::Vector3d> positions_;  ///< of frames where the tool was seen
  std::vector<double> reprojections_px_, depth_ratios_;
  std::map<std::string, int> reasons_;  ///< why it was not seen, and how often
};

}  // namespace softbody
