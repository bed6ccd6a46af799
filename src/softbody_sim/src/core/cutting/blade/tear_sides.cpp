#include "cutting/blade/tear_sides.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "softbody_common/statistics/median.h"
#include "softbody_common/statistics/robust.h"

namespace softbody {
namespace {

constexpr std::size_t kFewestOfSide = 20;  // marks; an affine map has 12 numbers
constexpr double kSureOfSide = 5.0;        // standard deviations

using Marks = std::vector<const TearMark*>;

/// Weighted least squares. Where the marks do not tell, the map is their rotation.
SideMotion fitted(const Marks& marks, const std::vector<double>& weights) {
  constexpr double kRotation = 1e-4;  // weight of the rotation, over that of the marks
  SideMotion result{Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero(), Eigen::Matrix3d::Identity()};
  const double sum = std::accumulate(weights.begin(), weights.end(), 0.0);
  for (std::size_t i = 0; i < marks.size(); ++i) {
    result.rest += weights[i] / sum * marks[i]->rest;
    result.measured += weights[i] / sum * marks[i]->measured;
  }
  Eigen::Matrix3d A = Eigen::Matrix3d::Zero(), B = A;
  for (std::size_t i = 0; i < marks.size(); ++i) {
    const Eigen::Vector3d arm = marks[i]->rest - result.rest;
    A += weights[i] * arm * arm.transpose();
    B += weights[i] * (marks[i]->measured - result.measured) * arm.transpose();
  }
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(B, Eigen::ComputeFullU | Eigen::ComputeFullV);
  const Eigen::Matrix3d U = svd.matrixU(), V = svd.matrixV();
  const Eigen::Vector3d signs(1.0, 1.0, (U * V.transpose()).determinant());
  const double prior = kRotation * A.trace();
  result.spread = (A + prior * Eigen::Matrix3d::Identity()).inverse();
  result.linear = (B + prior * U * signs.asDiagonal() * V.transpose()) * result.spread;
  return result;
}

std::vector<double> distancesFrom(const SideMotion& motion, const Marks& marks) {
  std::vector<double> distances;
  for (const TearMark* mark : marks) distances.push_back((motion.at(mark->rest) - mark->measured).norm());
  return distances;
}

std::optional<SideMotion> motionOf(const std::vector<TearMark>& marks, double side) {
  constexpr int kFits = 5;                       // the weights follow the fit, and the fit the weights
  constexpr double kScale = 2.0, kLeast = 1e-6;  // of the Cauchy weights, in medians; [m]
  Marks own;
  for (const TearMark& mark : marks)
    if (mark.side == side) own.push_back(&mark);
  if (own.size() < kFewestOfSide) return std::nullopt;
  std::vector<double> weights(own.size(), 1.0);
  SideMotion result;
  for (int fit = 0; fit < kFits; ++fit) {
    result = fitted(own, weights);
    const std::vector<double> distances = distancesFrom(result, own);
    result.median_m = std::max(medianOf(distances), kLeast);
    double squares = kLeast * kLeast;
    for (std::size_t i = 0; i < own.size(); ++i) {
      squares += distances[i] * distances[i];
      weights[i] = cauchyWeighted(1.0, std::pow(distances[i] / (kScale * result.median_m), 2));
    }
    // An affine map has 12 numbers, a mark 3.
    result.rms_m = std::sqrt(squares / (static_cast<double>(own.size()) - 4.0));
  }
  return result;
}

}  // namespace

double SideMotions::partingAt(const Eigen::Vector3d& point) const {
  return (above.at(point) - below.at(point)).norm() /
         std::sqrt(above.varianceAt(point) + below.varianceAt(point));
}

std::optional<SideMotions> sideMotions(const std::vector<TearMark>& marks) {
  const auto above = motionOf(marks, 1.0), below = motionOf(marks, -1.0);
  if (!above || !below) return std::nullopt;
  return SideMotions{*above, *below};
}

void takeSides(const TearZone& zone, std::vector<TearMark>* marks) {
  constexpr int kRounds = 3;  // the sides change the fits, and the fits the sides
  for (int round = 0; round < kRounds; ++round) {
    const auto motions = sideMotions(*marks);
    if (!motions) return;
    const double limit = kSureOfSide * std::max(motions->above.median_m, motions->below.median_m);
    std::vector<TearMark> taken = *marks;
    for (TearMark& mark : taken) {
      const double above = (motions->above.at(mark.rest) - mark.measured).norm(),
                   below = (motions->below.at(mark.rest) - mark.measured).norm();
      const bool near = std::abs(zone.plane.normal.dot(mark.rest - zone.plane.point)) < 2.0 * zone.place_m;
      const bool sure =
          std::min(above, below) < limit && std::abs(above * above - below * below) > limit * limit;
      mark.side = near && sure ? (above < below ? 1.0 : -1.0) : 0.0;
    }
    if (!sideMotions(taken)) return;
    *marks = std::move(taken);
  }
}

}  // namespace softbody
