#pragma once

#include <vector>

#include "registration/box_mesh.h"
#include "softbody_common/geometry/rigid_fit.h"

namespace softbody {

constexpr double kTableDepth = 0.6;  // [m]
/// The box flat on a table, seen from above; its upper side is 0.04 m nearer.
inline Eigen::Isometry3d lying(double x = 0.0, double y = 0.0, double lifted = 0.0) {
  return Eigen::Isometry3d(Eigen::Translation3d(x, y, kTableDepth - 0.02 - lifted));
}

/// Boxes on a table, or before a wall, with noise. @param behind its depth [m].
inline RgbdFrame boxesOnTable(const std::vector<Eigen::Isometry3d>& poses, double behind = kTableDepth) {
  RgbdFrame frame = renderFrame(kBox, transformed(kMesh.vertices, poses.front()), 1);
  for (const Eigen::Isometry3d& pose : poses)
    frame.depth = cv::min(frame.depth, renderFrame(kBox, transformed(kMesh.vertices, pose), 1).depth);
  frame.depth = cv::min(frame.depth, behind);
  cv::Mat1f noise(frame.depth.size());
  cv::theRNG().state = 1;
  cv::randn(noise, 0.0, 0.002);
  frame.depth += noise;
  return frame;
}

}  // namespace softbody
