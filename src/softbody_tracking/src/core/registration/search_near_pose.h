#pragma once

#include <Eigen/Geometry>

#include "registration/coarse_mesh.h"
#include "registration/found_pose.h"
#include "softbody_tracking/rgbd_frame.h"
#include "softbody_tracking/tracker_config.h"

namespace softbody {

/// Refines a rough pose of the body (wrong by a few centimetres and about 15 degrees): the coarse-to-fine
/// search from this pose and from small turns of it.
/// @return the best pose with its PoseCost; the caller decides whether the cost is acceptable.
PoseHypothesis searchNearPose(const RgbdFrame& frame, const SearchMeshes& meshes,
                              const Eigen::Isometry3d& rough_pose, const RegistrationConfig& config);

/// The same, accepted if its cost is small and the body has edges there.
/// @param config `max_cost` is the largest cost.
SearchOutcome searchNearAccepted(const RgbdFrame& frame, const SearchMeshes& meshes,
                                 const Eigen::Isometry3d& rough_pose, const RegistrationConfig& config);

}  // namespace softbody
