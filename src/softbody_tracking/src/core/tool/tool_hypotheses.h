#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tool/corner_noise.h"
#include "tool/pose_motion.h"
#include "tool/tool_pose.h"

namespace softbody {

/// A pose and the markers that agree with it.
struct ToolHypothesis {
  std::vector<const MarkerMeasurement*> markers;
  PoseEstimate estimate;
  double motion_cost = 0.0;     ///< squared Mahalanobis distance from the predicted pose, limited
  double unlikelihood = 0.0;    ///< -2 log of its likelihood, up to a constant
  bool against_motion = false;  ///< improbable after the motion so far
};

/// Hypotheses from both planar poses of each marker, each refined over all markers that agree with it. The
/// best comes first: most markers, then the most likely. Poses without an agreeing marker are left out.
/// @param noise of the corners; config.corner_std_px is not used.
std::vector<ToolHypothesis> toolHypotheses(const std::vector<MarkerMeasurement>& measurements,
                                           const Pinhole& camera,
                                           const std::optional<PoseMotion::Prediction>& predicted,
                                           const CornerNoise& noise, const ToolTrackerConfig& config);

/// Whether a pose with a clearly different rotation explains the markers nearly as well as the first.
/// @param with_motion the predicted motion counts, too.
bool isAmbiguous(const std::vector<ToolHypothesis>& best_first, bool with_motion,
                 const ToolTrackerConfig& config);

/// Covariance of the first pose if any of the hypotheses may be true: each adds its squared distance from the
/// first, by its probability.
PoseCovariance mixedCovariance(const std::vector<ToolHypothesis>& best_first);

}  // namespace softbody
