#pragma once

#include <Eigen/Geometry>

#include "registration/coarse_mesh.h"
#include "registration/found_pose.h"
#include "softbody_tracking/rgbd_frame.h"

namespace softbody {

/// Refines a rough pose of the body (wrong by a few centimetres and about 15 degrees): the coarse-to-fine
/// search from this pose and from small turns of it.
/// @return the best pose with its PoseCost; the caller decides whether the cost is acceptable.
PoseHypothesis searchNearPose(const RgbdFrame& frame, const SearchMeshes& meshes,
                              const Eigen::Isometry3d& rough_pose, double distance_scale_m);

}  // namespace softbody
