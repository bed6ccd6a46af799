#pragma once

#include "registration/coarse_mesh.h"
#include "registration/found_pose.h"
#include "registration/rough_pose.h"
#include "softbody_tracking/rgbd_frame.h"
#include "softbody_tracking/tracker_config.h"

namespace softbody {

/// Refines a rough pose of the body: the coarse-to-fine search from this pose, and from small turns and
/// shifts of it. If the body's picture is known, it decides between poses that explain the depth equally
/// well.
/// @return the best pose with its PoseCost; the caller decides whether it is acceptable.
PoseHypothesis searchNearPose(const RgbdFrame& frame, const SearchMeshes& meshes, const RoughPose& rough);

/// The same, accepted if the frame shows the body there (see isShown()) and the pose is not farther from the
/// rough one than three standard deviations.
SearchOutcome searchNearAccepted(const RgbdFrame& frame, const SearchMeshes& meshes, const RoughPose& rough);

}  // namespace softbody
