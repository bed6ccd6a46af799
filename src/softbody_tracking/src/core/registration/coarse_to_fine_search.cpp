#include "registration/coarse_to_fine_search.h"

#include <algorithm>
#include <tuple>
#include <utility>

#include "registration/subsampled_frame.h"

namespace softbody {
namespace {

// First steps of step 2: a pose after ICP is off by up to that.
constexpr PoseRefinement::Steps kCoarseSteps{0.1, 0.02};
// First steps of step 3: the precision that step 2 leaves.
constexpr PoseRefinement::Steps kFineSteps{0.02, 0.003};

std::vector<PoseHypothesis> searched(PoseRefinement* refinement, const PoseRefinement::Steps& steps,
                                     std::vector<PoseHypothesis> poses) {
  for (PoseHypothesis& pose : poses) pose = refinement->patternSearch(pose.pose, steps);
  return poses;
}

std::vector<PoseHypothesis> ranked(PoseCost* cost, double max_cost, std::vector<PoseHypothesis> poses) {
  std::vector<std::pair<double, PoseHypothesis>> rated;
  rated.reserve(poses.size());
  for (const PoseHypothesis& pose : poses) rated.emplace_back(-cost->support(pose.pose, max_cost), pose);
  std::stable_sort(rated.begin(), rated.end(), [](const auto& a, const auto& b) {
    return std::tie(a.first, a.second.cost) < std::tie(b.first, b.second.cost);
  });
  for (std::size_t i = 0; i < rated.size(); ++i) poses[i] = rated[i].second;
  return poses;
}

}  // namespace

void sortByCost(std::vector<PoseHypothesis>* poses) {
  std::stable_sort(poses->begin(), poses->end(),
                   [](const PoseHypothesis& a, const PoseHypothesis& b) { return a.cost < b.cost; });
}

CoarseToFineSearch::CoarseToFineSearch(const RgbdFrame& frame, const TriangleMesh& full,
                                       const TriangleMesh& coarse, const Alignment& alignment,
                                       const RegistrationConfig& config,
                                       const std::optional<Eigen::Isometry3d>& preferred)
    : icp_iterations_(alignment.icp_iterations),
      max_cost_(config.max_cost),
      small_(subsampled(frame, alignment.columns)),
      medium_(subsampled(frame, kMediumColumns)),
      large_(subsampled(frame, kLargeColumns)),
      alignment_(small_, coarse, config.distance_scale_m, preferred),
      refinement_(medium_, coarse, config.distance_scale_m, preferred),
      polishing_(large_, full, config.distance_scale_m, preferred) {}

Eigen::Isometry3d CoarseToFineSearch::turned(const Eigen::Isometry3d& pose,
                                             const Eigen::Vector3d& turn) const {
  return alignment_.moved(pose, turn, Eigen::Vector3d::Zero());
}

std::vector<PoseHypothesis> CoarseToFineSearch::align(const std::vector<Eigen::Isometry3d>& starts) {
  std::vector<PoseHypothesis> poses;
  poses.reserve(starts.size());
  for (const Eigen::Isometry3d& start : starts) {
    const Eigen::Isometry3d pose = alignment_.icp(start, icp_iterations_);
    poses.push_back({pose, alignment_.rankedCost(pose)});
  }
  sortByCost(&poses);
  return poses;
}

std::vector<PoseHypothesis> CoarseToFineSearch::refine(std::vector<PoseHypothesis> poses) {
  return searched(&refinement_, kCoarseSteps, std::move(poses));
}

std::vector<PoseHypothesis> CoarseToFineSearch::polish(std::vector<PoseHypothesis> poses) {
  return searched(&polishing_, kFineSteps, std::move(poses));
}

std::vector<PoseHypothesis> CoarseToFineSearch::rankRefined(std::vector<PoseHypothesis> poses) {
  return ranked(&refinement_.cost(), max_cost_, std::move(poses));
}

std::vector<PoseHypothesis> CoarseToFineSearch::rankPolished(std::vector<PoseHypothesis> poses) {
  return ranked(&polishing_.cost(), max_cost_, std::move(poses));
}

}  // namespace softbody
