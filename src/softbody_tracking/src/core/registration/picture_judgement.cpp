#include "registration/picture_judgement.h"

#include <algorithm>

#include "registration/different_poses.h"

namespace softbody {

std::vector<PicturedPose> PictureJudge::judged(const std::vector<PoseHypothesis>& poses) const {
  std::vector<PicturedPose> result;
  for (const PoseHypothesis& pose : poses) result.push_back({pose, fitAt(pose.pose)});
  std::stable_sort(result.begin(), result.end(), [](const PicturedPose& a, const PicturedPose& b) {
    return a.fit.evidence > b.fit.evidence;
  });
  return result;
}

PicturedPlace picturedPlace(const SearchMeshes& meshes, const std::vector<PicturedPose>& judged, int tried) {
  if (judged.empty() || !pictureFits(judged.front().fit, tried)) return {};
  const PicturedPose& best = judged.front();
  FoundPose found{best.pose.pose, 1};
  for (const PicturedPose& other : judged) {
    if (!differs(meshes, other.pose, best.pose) || !pictureFits(other.fit, tried)) continue;
    if (!inOnePlace(meshes, other.pose, best.pose)) return {std::nullopt, true};
    found.alike += best.fit.evidence - other.fit.evidence <= doubtSquared(tried) ? 1 : 0;
  }
  return {found, false};
}

}  // namespace softbody
