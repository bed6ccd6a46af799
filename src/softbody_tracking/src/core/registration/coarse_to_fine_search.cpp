#include "registration/coarse_to_fine_search.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <tuple>
#include <utility>

#include "agreement/subsampled_frame.h"

namespace softbody {
namespace {

// Iterations of the ICP from each start; more of them make no other pose the best.
constexpr int kIterations = 10;

std::vector<PoseHypothesis> ranked(PoseCost* cost, std::vector<PoseHypothesis> poses) {
  std::vector<std::pair<double, PoseHypothesis>> rated;
  rated.reserve(poses.size());
  for (const PoseHypothesis& pose : poses) rated.emplace_back(-cost->support(pose.pose), pose);
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

CoarseToFineSearch::CoarseToFineSearch(const RgbdFrame& frame, const SearchMeshes& meshes,
                                       const std::optional<RoughPose>& rough)
    : small_(subsampled(frame, kSmallColumns)),
      medium_(subsampled(frame, kMediumColumns)),
      large_(subsampled(frame, kLargeColumns)),
      alignment_(small_, meshes.coarse, rough),
      refinement_(medium_, meshes.coarse, rough),
      polishing_(large_, meshes.fine, rough) {}

Eigen::Isometry3d CoarseToFineSearch::turned(const Eigen::Isometry3d& pose,
                                             const Eigen::Vector3d& turn) const {
  return alignment_.moved(pose, turn, Eigen::Vector3d::Zero());
}

std::vector<Eigen::Isometry3d> CoarseToFineSearch::quarterTurned(const Eigen::Isometry3d& pose) const {
  std::vector<Eigen::Isometry3d> result;
  const Eigen::Matrix3d axes = pose.linear() * polishing_.axes();
  const Eigen::Vector3d x = M_PI_2 * axes.col(0), y = M_PI_2 * axes.col(1), z = M_PI_2 * axes.col(2);
  for (const Eigen::Vector3d& side :
       {Eigen::Vector3d(0.0 * x), x, Eigen::Vector3d(2.0 * x), Eigen::Vector3d(-x), y, Eigen::Vector3d(-y)})
    for (int quarter = 0; quarter < 4; ++quarter) result.push_back(turned(turned(pose, quarter * z), side));
  return result;
}

std::vector<PoseHypothesis> CoarseToFineSearch::align(const std::vector<Eigen::Isometry3d>& starts) const {
  std::vector<PoseHypothesis> poses(starts.size());
  tbb::parallel_for(std::size_t{0}, starts.size(), [&](std::size_t i) {
    PoseRefinement alignment = alignment_;
    poses[i].pose = alignment.icp(starts[i], kIterations);
    poses[i].cost = alignment.rankedCost(poses[i].pose);
  });
  sortByCost(&poses);
  return poses;
}

std::vector<PoseHypothesis> CoarseToFineSearch::refine(std::vector<PoseHypothesis> poses) const {
  tbb::parallel_for(std::size_t{0}, poses.size(), [&](std::size_t i) {
    PoseRefinement refinement = refinement_;
    poses[i] = refinement.patternSearch(poses[i].pose, alignment_.scaleAt(poses[i].pose));
  });
  return poses;
}

std::vector<PoseHypothesis> CoarseToFineSearch::polish(std::vector<PoseHypothesis> poses) const {
  tbb::parallel_for(std::size_t{0}, poses.size(), [&](std::size_t i) {
    PoseRefinement polishing = polishing_;
    poses[i] = polishing.patternSearch(poses[i].pose, refinement_.pixelAt(poses[i].pose));
  });
  return poses;
}

std::vector<PoseHypothesis> CoarseToFineSearch::rankRefined(std::vector<PoseHypothesis> poses) {
  return ranked(&refinement_.cost(), std::move(poses));
}

std::vector<PoseHypothesis> CoarseToFineSearch::rankPolished(std::vector<PoseHypothesis> poses) {
  return ranked(&polishing_.cost(), std::move(poses));
}

}  // namespace softbody
