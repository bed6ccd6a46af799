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
  double motion_cost = 0.0;  ///< squared Mahalanobis distance from the predicted pose, limited
};

/// Hypotheses from both planar poses of each marker, each refined over all markers that agree with it. The
/// best comes first: most markers, then least cost of corners, depth and motion. Poses without an agreeing
/// marker are left out.
std::vector<ToolHypothesis> toolHypotheses(const std::vector<MarkerMeasurement>& measurements,
                                           const Pinhole& camera,
                                           const std::optional<PoseMotion::Prediction>& predicted,
                                           const ToolTrackerConfig& config);

/// Whether a pose with a clearly different rotation explains the markers nearly as well as the first.
bool isAmbiguous(const std::vector<ToolHypothesis>& best_first, const ToolTrackerConfig& config);

}  // namespace softbody
