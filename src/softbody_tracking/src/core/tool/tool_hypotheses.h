#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tool/pose_motion.h"
#include "tool/tool_pose.h"

namespace softbody {

/// A pose and the markers that agree with it.
struct ToolHypothesis {
  std::vector<const MarkerMeasurement*> markers;
  PoseEstimate estimate;
  double motion_cost = 0.0;  ///< squared Mahalanobis distance from the predicted pose, bounded
};

/// Both planar solutions of every marker, each refined over all markers that agree with it, best first: most
/// markers, then least cost of corners, depth and motion. Poses that no marker agrees with are left out.
std::vector<ToolHypothesis> toolHypotheses(const std::vector<MarkerMeasurement>& measurements,
                                           const Pinhole& camera,
                                           const std::optional<PoseMotion::Prediction>& predicted,
                                           const ToolTrackerConfig& config);

/// Whether another pose, clearly turned against the first, explains the same markers about as well.
bool isAmbiguous(const std::vector<ToolHypothesis>& best_first, const ToolTrackerConfig& config);

}  // namespace softbody
