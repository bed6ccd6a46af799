#include "registration/search_anywhere.h"

#include <algorithm>
#include <cmath>

#include "agreement/acceptance.h"
#include "registration/body_candidates.h"
#include "registration/coarse_to_fine_search.h"
#include "registration/different_poses.h"
#include "registration/picture_judgement.h"
#include "registration/search_starts.h"

namespace softbody {
namespace {

// Orientations that are refined at a place where the picture decides: half of the body may be hidden, and
// then its true pose costs more than some others.
constexpr std::size_t kKeptWithPicture = 24;

/// The starts at each place where the body may be.
std::vector<std::vector<Eigen::Isometry3d>> startsByPlace(const RgbdFrame& frame, const RegionColors& colors,
                                                          const SearchMeshes& meshes,
                                                          const std::vector<Eigen::Isometry3d>& guesses) {
  std::vector<BodyCandidate> candidates = findBodyCandidates(frame, colors, meshes.diameter_m);
  candidates.resize(std::min(candidates.size(), kKept));
  std::vector<std::vector<Eigen::Isometry3d>> result;
  if (!guesses.empty()) result.push_back(guesses);
  for (const BodyCandidate& candidate : candidates)
    result.push_back(allOrientations(meshes, candidate.center));
  return result;
}

/// Adds the poses of one place at which the picture fits best.
void addPictured(const RgbdFrame& frame, const SearchMeshes& meshes, const std::vector<PoseHypothesis>& here,
                 std::vector<PoseHypothesis>* poses) {
  std::vector<PicturedPose> judged = PictureJudge(frame, meshes).judged(here);
  judged.resize(std::min(judged.size(), kKept));
  for (const PicturedPose& pose : judged) poses->push_back(pose.pose);
}

/// Leaves out the poses at which something else than the picture is seen. @return where it is seen.
PicturedPlace judgeByPicture(const RgbdFrame& frame, const SearchMeshes& meshes,
                             std::vector<PoseHypothesis>* poses) {
  if (meshes.picture.empty()) return {};
  const int tried = static_cast<int>(poses->size());
  const PictureJudge judge(frame, meshes);
  const auto is_another = [&](const PoseHypothesis& pose) {
    return pictureDisagrees(judge.fitAt(pose.pose), tried);
  };
  poses->erase(std::remove_if(poses->begin(), poses->end(), is_another), poses->end());
  return picturedPlace(meshes, judge.judged(*poses), tried);
}

/// Moves the poses that are alike with the first one to the front. @return the end of these.
std::vector<PoseHypothesis>::iterator groupAlike(const SearchMeshes& meshes,
                                                 std::vector<PoseHypothesis>* poses) {
  const PoseHypothesis best = poses->front();
  return std::stable_partition(poses->begin() + 1, poses->end(), [&](const PoseHypothesis& pose) {
    return std::abs(pose.cost - best.cost) <= kAlikeCost && inOnePlace(meshes, pose, best);
  });
}

}  // namespace

std::vector<PoseHypothesis> posesAnywhere(const RgbdFrame& frame, const RegionColors& colors,
                                          const SearchMeshes& meshes,
                                          const std::vector<Eigen::Isometry3d>& guesses) {
  CoarseToFineSearch search(frame, meshes);
  std::vector<PoseHypothesis> found, best_of_places;
  const std::size_t kept = meshes.picture.empty() ? kKept : kKeptWithPicture;
  for (const auto& starts : startsByPlace(search.mediumFrame(), colors, meshes, guesses)) {
    const std::vector<PoseHypothesis> here =
        search.rankRefined(search.refine(distinct(meshes, search.align(starts), kept)));
    best_of_places.push_back(here.front());
    if (!meshes.picture.empty()) addPictured(frame, meshes, here, &best_of_places);
    found.insert(found.end(), here.begin(), here.end());
  }
  found = distinct(meshes, search.rankRefined(std::move(found)), kKept);
  // The best of every place is polished too: the coarse mesh may fit another object better than the body.
  found.insert(found.end(), best_of_places.begin(), best_of_places.end());
  found = distinct(meshes, found, found.size());
  found = search.rankPolished(search.polish(std::move(found)));
  return distinct(meshes, found, found.size());
}

SearchOutcome searchAnywhere(const RgbdFrame& frame, const RegionColors& colors, const SearchMeshes& meshes,
                             const std::vector<Eigen::Isometry3d>& guesses, const FeatureShare& feature_share,
                             const std::optional<RoughPose>& expected) {
  std::vector<PoseHypothesis> found = posesAnywhere(frame, colors, meshes, guesses);
  SearchOutcome outcome;
  if (!found.empty()) outcome.best = found.front();
  const auto implausible = [&](const PoseHypothesis& pose) {
    return !isShown(frame, meshes.fine, pose.pose);
  };
  // Without its features the body is taken where it is expected, or where it stands free.
  const auto is_likely = [&](const Eigen::Isometry3d& pose) {
    const Eigen::Vector3d center = meshes.full.vertices.colwise().mean();
    if (expected) return deviationFrom(*expected, pose, center).shift <= kDoubt;
    return standsFree(frame, meshes.fine, pose);
  };
  const std::size_t tried = found.size();
  found.erase(std::remove_if(found.begin(), found.end(), implausible), found.end());
  const std::size_t plausible = found.size();
  const PicturedPlace pictured = judgeByPicture(frame, meshes, &found);
  const RefusedPoses refused{tried, tried - plausible, plausible - found.size(), pictured.several};
  for (bool first = true; !found.empty();) {
    const auto others = groupAlike(meshes, &found);
    AlikePoses alike;
    for (auto pose = found.begin(); pose != others; ++pose) {
      alike.poses.push_back(pose->pose);
      alike.shares.push_back(feature_share(pose->pose));
    }
    if (const std::optional<FoundPose> body = confirmedPose(alike)) return {body, outcome.best, {}};
    if (first && !pictured.several && !pictured.body && is_likely(alike.poses.front())) {
      outcome.found = undecidedPose(alike);
      first = false;
    }
    found.erase(found.begin(), others);
  }
  if (pictured.body && feature_share(pictured.body->pose) < 0.0) outcome.found = pictured.body;
  if (!outcome.found && !meshes.picture.empty()) outcome.refused = refused;
  return outcome;
}

}  // namespace softbody
