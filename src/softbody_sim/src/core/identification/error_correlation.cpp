#include "identification/error_correlation.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <utility>

namespace softbody {
namespace {

using Indices = std::vector<std::size_t>;

void halve(const std::vector<ResidualPlace>& places, int halvings, Indices::iterator begin,
           Indices::iterator end, std::vector<int>* patch, int* next) {
  if (halvings == 0 || end - begin < 2) {
    for (auto k = begin; k != end; ++k) (*patch)[*k] = *next;
    ++*next;
    return;
  }
  Eigen::AlignedBox3d box;
  for (auto k = begin; k != end; ++k) box.extend(places[*k].rest);
  Eigen::Index axis = 0;
  box.sizes().maxCoeff(&axis);
  const auto middle = begin + (end - begin) / 2;
  std::nth_element(begin, middle, end, [&](std::size_t a, std::size_t b) {
    return std::make_pair(places[a].rest[axis], a) < std::make_pair(places[b].rest[axis], b);
  });
  halve(places, halvings - 1, begin, middle, patch, next);
  halve(places, halvings - 1, middle, end, patch, next);
}

/// Contiguous blocks of images.
std::vector<int> blocksOf(const std::vector<ResidualPlace>& places, int images_per_block) {
  std::vector<int> block;
  for (const ResidualPlace& place : places) block.push_back(place.image / images_per_block);
  return block;
}

std::vector<int> intersection(const std::vector<int>& a, const std::vector<int>& b) {
  std::map<std::pair<int, int>, int> index;
  std::vector<int> both;
  for (std::size_t k = 0; k < a.size(); ++k)
    both.push_back(index.emplace(std::make_pair(a[k], b[k]), static_cast<int>(index.size())).first->second);
  return both;
}

/// Variances of the unknowns if errors are dependent only within a cluster; empty if there are too few
/// clusters to tell. @param influence #R by #U: of each residual on each unknown.
Eigen::VectorXd clusteredVariances(const Eigen::MatrixXd& influence, const std::vector<int>& clusters) {
  std::map<int, Eigen::VectorXd> sums;
  for (std::size_t k = 0; k < clusters.size(); ++k) {
    auto [sum, is_new] = sums.emplace(clusters[k], Eigen::VectorXd());
    if (is_new) sum->second.setZero(influence.cols());
    sum->second += influence.row(static_cast<Eigen::Index>(k)).transpose();
  }
  const auto count = static_cast<double>(sums.size()), unknowns = static_cast<double>(influence.cols());
  if (count < 2.0 * unknowns) return {};  // the fit itself takes a part of the errors out of the sums
  Eigen::VectorXd variances = Eigen::VectorXd::Zero(influence.cols());
  for (const auto& [cluster, sum] : sums) variances += sum.cwiseAbs2();
  return variances * count / (count - unknowns);
}

}  // namespace

std::vector<int> patchesOf(const std::vector<ResidualPlace>& places, int halvings) {
  std::vector<int> patch(places.size(), 0);
  Indices of_targets;
  for (std::size_t k = 0; k < places.size(); ++k)
    if (places[k].sensor < 0) of_targets.push_back(k);
  int next = 0;
  halve(places, halvings, of_targets.begin(), of_targets.end(), &patch, &next);
  for (std::size_t k = 0; k < places.size(); ++k)
    if (places[k].sensor >= 0) patch[k] = next + places[k].sensor;
  return patch;
}

Eigen::VectorXd correlationFactors(const std::vector<ResidualPlace>& places, const Eigen::MatrixXd& jacobian,
                                   const Eigen::VectorXd& residuals, const Eigen::MatrixXd& covariance) {
  const Eigen::MatrixXd influence = residuals.asDiagonal() * (jacobian * covariance);
  const Eigen::VectorXd independent = covariance.diagonal();
  Eigen::VectorXd largest = independent;
  const auto images =
      1 + std::accumulate(places.begin(), places.end(), 0,
                          [](int most, const ResidualPlace& p) { return std::max(most, p.image); });
  std::vector<std::vector<int>> blocks;
  for (int length = 1; images / length >= 2 * influence.cols(); length *= 2)
    blocks.push_back(blocksOf(places, length));
  for (int halvings = 3; halvings <= 8; ++halvings) {
    const std::vector<int> patches = patchesOf(places, halvings);
    const Eigen::VectorXd of_patches = clusteredVariances(influence, patches);
    if (of_patches.size() == 0) continue;
    largest = largest.cwiseMax(of_patches);
    for (const std::vector<int>& block : blocks) {
      const Eigen::VectorXd of_blocks = clusteredVariances(influence, block),
                            of_both = clusteredVariances(influence, intersection(patches, block));
      if (of_blocks.size() > 0 && of_both.size() > 0)
        largest = largest.cwiseMax(of_blocks).cwiseMax(of_patches + of_blocks - of_both);
    }
  }
  return largest.cwiseQuotient(independent);
}

}  // namespace softbody
