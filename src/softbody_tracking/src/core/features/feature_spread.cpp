#include "features/feature_spread.h"

#include <algorithm>
#include <limits>

namespace softbody {
namespace {

// Candidates that count as strong, at least; a few strong ones could all lie in one place.
constexpr int kFewestStrong = 500;
// Weak candidates that are taken at most, and at most half of those wanted: they are found again less
// reliably.
constexpr int kMostWeak = 300;
// Bisection steps; then the distance is known to a thousandth of the body.
constexpr int kSearches = 12;

float squaredDistance(const Eigen::Ref<const Eigen::Matrix3Xf>& places, const Eigen::Vector3f& place) {
  if (places.cols() == 0) return std::numeric_limits<float>::max();
  return (places.colwise() - place).colwise().squaredNorm().minCoeff();
}

/// The candidates at least a distance apart; at most one more than wanted.
std::vector<int> apart(const Eigen::Matrix3Xf& ranked, const std::vector<float>& to_known, float distance,
                       int wanted) {
  const float least = distance * distance;
  Eigen::Matrix3Xf taken(3, wanted + 1);
  std::vector<int> result;
  for (int i = 0; i < ranked.cols() && static_cast<int>(result.size()) <= wanted; ++i) {
    const auto count = static_cast<Eigen::Index>(result.size());
    if (to_known[i] < least || squaredDistance(taken.leftCols(count), ranked.col(i)) < least) continue;
    taken.col(count) = ranked.col(i);
    result.push_back(i);
  }
  return result;
}

/// The candidates further than the gap from all others.
std::vector<int> inGaps(const Eigen::Matrix3Xf& ranked, const Eigen::Matrix3Xf& others, double gap_m) {
  const auto least = static_cast<float>(gap_m * gap_m);
  std::vector<int> result;
  for (int i = 0; i < ranked.cols(); ++i) {
    if (squaredDistance(others, ranked.col(i)) > least) result.push_back(i);
  }
  return result;
}

}  // namespace

std::vector<int> spreadOut(const Eigen::Matrix3Xf& ranked, const Eigen::Matrix3Xf& known, int wanted,
                           double gap_m) {
  if (wanted <= 0) return {};
  std::vector<float> to_known(ranked.cols());
  for (int i = 0; i < ranked.cols(); ++i) to_known[i] = squaredDistance(known, ranked.col(i));
  auto near = static_cast<float>(gap_m);
  std::vector<int> best = apart(ranked, to_known, near, wanted);
  const auto enough = static_cast<std::size_t>(wanted);
  if (best.size() <= enough) return best;
  float far = (ranked.rowwise().maxCoeff() - ranked.rowwise().minCoeff()).norm();
  for (int k = 0; k < kSearches && best.size() != enough; ++k) {
    const float distance = 0.5f * (near + far);
    std::vector<int> found = apart(ranked, to_known, distance, wanted);
    const bool too_few = found.size() < enough;
    (too_few ? far : near) = distance;
    if (!too_few) best = std::move(found);
  }
  best.resize(enough);
  return best;
}

std::vector<int> spreadStrong(const Eigen::Matrix3Xf& ranked, int wanted, double gap_m) {
  const Eigen::Index strong = std::min<Eigen::Index>(ranked.cols(), std::max(kFewestStrong, wanted));
  std::vector<int> result =
      spreadOut(ranked.leftCols(strong), {}, wanted - std::min(wanted / 2, kMostWeak), 0.0);
  const Eigen::Matrix3Xf taken = ranked(Eigen::all, result);
  const std::vector<int> weak = inGaps(ranked, taken, gap_m);
  const int left = wanted - static_cast<int>(result.size());
  for (const int i : spreadOut(ranked(Eigen::all, weak), taken, left, 0.0)) result.push_back(weak[i]);
  return result;
}

}  // namespace softbody
