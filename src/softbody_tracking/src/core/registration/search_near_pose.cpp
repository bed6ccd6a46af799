#include "registration/search_near_pose.h"

#include <vector>

#include "agreement/acceptance.h"
#include "registration/coarse_to_fine_search.h"
#include "registration/search_starts.h"

namespace softbody {

PoseHypothesis searchNearPose(const RgbdFrame& frame, const SearchMeshes& meshes, const RoughPose& rough,
                              const RegistrationConfig& config) {
  CoarseToFineSearch search(frame, meshes, config, rough);
  std::vector<Eigen::Isometry3d> starts;
  for (const Eigen::Vector3d& turn : smallTurns()) starts.push_back(search.turned(rough.pose, turn));
  for (const Eigen::Vector3d& shift : shiftsWithin(2.0 * rough.std_m, kOtherPlace * meshes.diameter_m))
    starts.push_back(Eigen::Translation3d(shift) * rough.pose);
  std::vector<PoseHypothesis> poses = search.align(starts);
  poses.resize(kKept);  // ICP may slide, so the best one need not stay the best;
  poses = search.refine(std::move(poses));
  sortByCost(&poses);
  const Eigen::Isometry3d pose = search.polish({poses.front()}).front().pose;
  return {pose, search.polishedCost(pose)};
}

SearchOutcome searchNearAccepted(const RgbdFrame& frame, const SearchMeshes& meshes, const RoughPose& rough,
                                 const RegistrationConfig& config) {
  const PoseHypothesis best = searchNearPose(frame, meshes, rough, config);
  const Eigen::Vector3d center = meshes.full.vertices.colwise().mean();
  const bool accepted = isNear(rough, best.pose, center) && isShown(frame, meshes.full, best.pose, config);
  return {accepted ? std::optional(FoundPose{best.pose, 1}) : std::nullopt, best};
}

}  // namespace softbody
