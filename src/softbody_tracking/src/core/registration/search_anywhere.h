#pragma once

#include <optional>
#include <vector>

#include "labels/region_colors.h"
#include "registration/coarse_mesh.h"
#include "registration/feature_confirmation.h"
#include "registration/found_pose.h"
#include "registration/rough_pose.h"
#include "softbody_tracking/rgbd_frame.h"
#include "softbody_tracking/tracker_config.h"

namespace softbody {

/// Plausible poses of the body anywhere in a frame, in any orientation: the coarse-to-fine search from all
/// orientations at each candidate in the depth image.
/// @param colors if learned, only pixels of the body's colours are candidates. @param guesses further starts.
/// @return poses that differ by more than 20 degrees or a fifth of the body's size, at least one for each
/// candidate; the ones with the most depth support come first. Empty without candidates.
std::vector<PoseHypothesis> posesAnywhere(const RgbdFrame& frame, const RegionColors& colors,
                                          const SearchMeshes& meshes,
                                          const std::vector<Eigen::Isometry3d>& guesses);

/// Finds the body without a pose. Among poses that look alike in depth, the one with the most features wins.
/// If features contradict a place, or cannot decide, the next place is tried; there the features must confirm
/// the pose.
/// @param guesses poses to try as well. @param expected if given, a pose is taken elsewhere only if features
/// confirm it; its turn does not matter.
SearchOutcome searchAnywhere(const RgbdFrame& frame, const RegionColors& colors, const SearchMeshes& meshes,
                             const std::vector<Eigen::Isometry3d>& guesses, const FeatureShare& feature_share,
                             const std::optional<RoughPose>& expected = std::nullopt);

}  // namespace softbody
