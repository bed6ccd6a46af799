#include "registration/different_poses.h"

#include <algorithm>

namespace softbody {

bool inOnePlace(const SearchMeshes& meshes, const PoseHypothesis& a, const PoseHypothesis& b) {
  const Eigen::Vector3d center = meshes.full.vertices.colwise().mean().transpose();
  return (a.pose * center - b.pose * center).norm() <= kOtherPlace * meshes.diameter_m;
}

bool differs(const SearchMeshes& meshes, const PoseHypothesis& a, const PoseHypothesis& b) {
  const Eigen::Isometry3d between = a.pose.inverse() * b.pose;
  return Eigen::AngleAxisd(between.linear()).angle() > kOtherTurn || !inOnePlace(meshes, a, b);
}

std::vector<PoseHypothesis> distinct(const SearchMeshes& meshes, const std::vector<PoseHypothesis>& poses,
                                     std::size_t most) {
  std::vector<PoseHypothesis> kept;
  for (const PoseHypothesis& pose : poses) {
    const bool is_new = std::all_of(
        kept.begin(), kept.end(), [&](const PoseHypothesis& other) { return differs(meshes, pose, other); });
    if (is_new && kept.size() < most) kept.push_back(pose);
  }
  return kept;
}

}  // namespace softbody
