#include "registration/search_near_pose.h"

#include <vector>

#include "registration/body_edges.h"
#include "registration/coarse_to_fine_search.h"
#include "registration/search_starts.h"

namespace softbody {

PoseHypothesis searchNearPose(const RgbdFrame& frame, const SearchMeshes& meshes,
                              const Eigen::Isometry3d& rough_pose, const RegistrationConfig& config) {
  CoarseToFineSearch search(frame, meshes, config, rough_pose);
  std::vector<Eigen::Isometry3d> starts;
  for (const Eigen::Vector3d& turn : smallTurns()) starts.push_back(search.turned(rough_pose, turn));
  std::vector<PoseHypothesis> poses = search.align(starts);
  poses.resize(kKept);  // ICP may slide, so the best one need not stay the best;
  poses = search.refine(std::move(poses));
  sortByCost(&poses);
  const Eigen::Isometry3d pose = search.polish({poses.front()}).front().pose;
  return {pose, search.polishedCost(pose)};
}

SearchOutcome searchNearAccepted(const RgbdFrame& frame, const SearchMeshes& meshes,
                                 const Eigen::Isometry3d& rough_pose, const RegistrationConfig& config) {
  const PoseHypothesis best = searchNearPose(frame, meshes, rough_pose, config);
  const bool accepted =
      best.cost <= config.max_cost &&
      shareWithoutEdge(frame, meshes.full, best.pose, config.distance_scale_m) <= kLargestShareWithoutEdge;
  return {accepted ? std::optional(FoundPose{best.pose, 1}) : std::nullopt, best};
}

}  // namespace softbody
