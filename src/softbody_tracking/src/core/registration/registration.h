#pragma once

#include <Eigen/Geometry>

#include "softbody_common/types.h"
#include "softbody_tracking/rgbd_frame.h"
#include "softbody_tracking/tracker_config.h"

namespace softbody {

struct RegistrationResult {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();  ///< rest frame in the camera frame
  double cost = 1.0;                                       ///< mean cost a pixel, 0 perfect
};

/// How badly a posed mesh explains a depth image, 0..1: the mean over the pixels it covers of the squared
/// depth difference in units of `distance_scale_m` (beyond 1 m times the distance), capped at 1 (free space
/// seen through it, or hidden behind something), plus the share of its outline beyond which the depth goes on
/// as if the body were larger.
double poseCost(const RgbdFrame& frame, const TriangleMesh& mesh, const Eigen::Isometry3d& pose,
                double distance_scale_m);

/// Rigid registration of a mesh at rest from a rough pose (a few centimetres, some 15 degrees): projective
/// point-to-plane ICP (Besl and McKay 1992; Chen and Medioni 1992) from perturbed starts, the best of them by
/// poseCost, refined by direct search on poseCost, which sees the outline where ICP may slide.
/// @param coarse stands for the mesh in the search at low resolution; may be the mesh itself.
RegistrationResult registerBody(const RgbdFrame& frame, const TriangleMesh& mesh, const TriangleMesh& coarse,
                                const Eigen::Isometry3d& rough_pose, const RegistrationConfig& config);

}  // namespace softbody
