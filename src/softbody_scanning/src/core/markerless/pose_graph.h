#pragma once

#include <vector>

#include "markerless/small_motion.h"

namespace softbody::scanning {

/// A measured relative pose of two frames.
struct PoseEdge {
  int from = 0, to = 0;
  Eigen::Isometry3d T_to_from = Eigen::Isometry3d::Identity();
  PoseCovariance covariance = PoseCovariance::Zero();
};

/// Adjusts poses T_camera_model so that the edges agree best (Cauchy's loss). The first pose stays.
/// @return covariances of the poses, small motions in the camera frames.
std::vector<PoseCovariance> adjustPoses(const std::vector<PoseEdge>& edges,
                                        std::vector<Eigen::Isometry3d>* poses);

}  // namespace softbody::scanning
