#include "registration/search_near_pose.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "agreement/acceptance.h"
#include "registration/coarse_to_fine_search.h"
#include "registration/different_poses.h"
#include "registration/picture_judgement.h"
#include "registration/search_starts.h"

namespace softbody {
namespace {

Eigen::Isometry3d bestNear(CoarseToFineSearch* search, const SearchMeshes& meshes, const RoughPose& rough) {
  std::vector<Eigen::Isometry3d> starts;
  for (const Eigen::Vector3d& turn : smallTurns()) starts.push_back(search->turned(rough.pose, turn));
  for (const Eigen::Vector3d& shift : shiftsWithin(2.0 * rough.std_m, kOtherPlace * meshes.diameter_m))
    starts.push_back(Eigen::Translation3d(shift) * rough.pose);
  std::vector<PoseHypothesis> poses = search->align(starts);
  poses.resize(kKept);  // ICP may slide, so the best one need not stay the best;
  poses = search->refine(std::move(poses));
  sortByCost(&poses);
  return search->polish({poses.front()}).front().pose;
}

Eigen::Vector3d centerOf(const SearchMeshes& meshes) { return meshes.full.vertices.colwise().mean(); }

/// The poses within the rough pose's uncertainty that explain the depth as well as the best one. That one is
/// the first.
std::vector<PoseHypothesis> alikeNear(CoarseToFineSearch* search, const SearchMeshes& meshes,
                                      const RoughPose& rough, const PoseHypothesis& best) {
  std::vector<PoseHypothesis> alike = {best};
  for (const Eigen::Isometry3d& turned : search->quarterTurned(best.pose)) {
    if (!isNear(rough, turned, centerOf(meshes))) continue;
    const Eigen::Isometry3d pose = search->polish({{turned, 1.0}}).front().pose;
    const PoseHypothesis other{pose, search->polishedCost(pose)};
    if (other.cost <= best.cost + kAlikeCost && isNear(rough, pose, centerOf(meshes))) alike.push_back(other);
  }
  return distinct(meshes, alike, alike.size());
}

/// Of the alike poses the one that the picture shows clearly; otherwise the first.
PoseHypothesis likeliest(const RgbdFrame& frame, const SearchMeshes& meshes,
                         const std::vector<PoseHypothesis>& alike) {
  const PicturedPlace place =
      picturedPlace(meshes, PictureJudge(frame, meshes).judged(alike), static_cast<int>(alike.size()));
  if (!place.body || place.body->alike > 1) return alike.front();
  return *std::find_if(alike.begin(), alike.end(),
                       [&](const PoseHypothesis& pose) { return pose.pose.isApprox(place.body->pose, 0.0); });
}

}  // namespace

PoseHypothesis searchNearPose(const RgbdFrame& frame, const SearchMeshes& meshes, const RoughPose& rough) {
  CoarseToFineSearch search(frame, meshes, rough);
  const Eigen::Isometry3d pose = bestNear(&search, meshes, rough);
  const PoseHypothesis best{pose, search.polishedCost(pose)};
  if (meshes.picture.empty()) return best;
  return likeliest(frame, meshes, alikeNear(&search, meshes, rough, best));
}

SearchOutcome searchNearAccepted(const RgbdFrame& frame, const SearchMeshes& meshes, const RoughPose& rough) {
  const PoseHypothesis best = searchNearPose(frame, meshes, rough);
  const bool accepted = isNear(rough, best.pose, centerOf(meshes)) && isShown(frame, meshes.fine, best.pose);
  return {accepted ? std::optional(FoundPose{best.pose, 1}) : std::nullopt, best};
}

}  // namespace softbody
