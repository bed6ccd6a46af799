#include "registration/search_anywhere.h"

#include <algorithm>
#include <cmath>

#include "agreement/acceptance.h"
#include "registration/body_candidates.h"
#include "registration/coarse_to_fine_search.h"
#include "registration/search_starts.h"

namespace softbody {
namespace {

bool inOnePlace(const SearchMeshes& meshes, const PoseHypothesis& a, const PoseHypothesis& b) {
  const Eigen::Vector3d center = meshes.full.vertices.colwise().mean().transpose();
  return (a.pose * center - b.pose * center).norm() <= kOtherPlace * meshes.diameter_m;
}

/// The first poses that differ from those before them.
std::vector<PoseHypothesis> distinct(const SearchMeshes& meshes, const std::vector<PoseHypothesis>& poses,
                                     std::size_t most) {
  const auto differs = [&](const PoseHypothesis& a, const PoseHypothesis& b) {
    const Eigen::Isometry3d between = a.pose.inverse() * b.pose;
    return Eigen::AngleAxisd(between.linear()).angle() > kOtherTurn || !inOnePlace(meshes, a, b);
  };
  std::vector<PoseHypothesis> kept;
  for (const PoseHypothesis& pose : poses) {
    const bool is_new = std::all_of(kept.begin(), kept.end(),
                                    [&](const PoseHypothesis& other) { return differs(pose, other); });
    if (is_new && kept.size() < most) kept.push_back(pose);
  }
  return kept;
}

/// The starts at each place where the body may be.
std::vector<std::vector<Eigen::Isometry3d>> startsByPlace(const RgbdFrame& frame, const RegionColors& colors,
                                                          const SearchMeshes& meshes,
                                                          const std::vector<Eigen::Isometry3d>& guesses,
                                                          const RegistrationConfig& config) {
  std::vector<BodyCandidate> candidates =
      findBodyCandidates(frame, colors, meshes.diameter_m, config.distance_scale_m);
  candidates.resize(std::min(candidates.size(), kKept));
  std::vector<std::vector<Eigen::Isometry3d>> result;
  if (!guesses.empty()) result.push_back(guesses);
  for (const BodyCandidate& candidate : candidates)
    result.push_back(allOrientations(meshes, candidate.center));
  return result;
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
                                          const std::vector<Eigen::Isometry3d>& guesses,
                                          const RegistrationConfig& config) {
  CoarseToFineSearch search(frame, meshes, config);
  std::vector<PoseHypothesis> found, best_of_places;
  for (const auto& starts : startsByPlace(search.mediumFrame(), colors, meshes, guesses, config)) {
    const std::vector<PoseHypothesis> here =
        search.rankRefined(search.refine(distinct(meshes, search.align(starts), kKept)));
    best_of_places.push_back(here.front());
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
                             const RegistrationConfig& config, const std::optional<RoughPose>& expected) {
  std::vector<PoseHypothesis> found = posesAnywhere(frame, colors, meshes, guesses, config);
  SearchOutcome outcome;
  if (!found.empty()) outcome.best = found.front();
  const auto implausible = [&](const PoseHypothesis& pose) {
    return !isShown(frame, meshes.full, pose.pose, config);
  };
  // Without its features the body is taken where it is expected, or where it stands free.
  const auto is_likely = [&](const Eigen::Isometry3d& pose) {
    const Eigen::Vector3d center = meshes.full.vertices.colwise().mean();
    if (expected) return deviationFrom(*expected, pose, center).shift <= kDoubt;
    return standsFree(frame, meshes.full, pose, config);
  };
  found.erase(std::remove_if(found.begin(), found.end(), implausible), found.end());
  for (bool first = true; !found.empty();) {
    const auto others = groupAlike(meshes, &found);
    AlikePoses alike;
    for (auto pose = found.begin(); pose != others; ++pose) {
      alike.poses.push_back(pose->pose);
      alike.shares.push_back(feature_share(pose->pose));
    }
    if (const std::optional<FoundPose> body = confirmedPose(alike)) return {body, outcome.best};
    if (first && is_likely(alike.poses.front())) {
      outcome.found = undecidedPose(alike);
      first = false;
    }
    found.erase(found.begin(), others);
  }
  return outcome;
}

}  // namespace softbody
