#include "cage/half_spaces.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <limits>

namespace softbody {
namespace {

constexpr double kDependent = 1e-6;  ///< sine of the angle below which two normals count as parallel

double violation(const std::vector<HalfSpace>& half_spaces, const Eigen::Vector3d& x) {
  double worst = -std::numeric_limits<double>::infinity();
  for (const HalfSpace& h : half_spaces) worst = std::max(worst, h.offset - h.normal.dot(x));
  return worst;
}

/// The point's projection onto the intersection of 1 to 3 planes, if it is optimal (Karush-Kuhn-Tucker: no
/// multiplier is negative, no half-space is violated).
template <std::size_t kPlanes>
std::optional<Eigen::Vector3d> solution(const std::vector<HalfSpace>& half_spaces,
                                        const Eigen::Vector3d& point,
                                        const std::array<std::size_t, kPlanes>& active, double tolerance) {
  constexpr int n = static_cast<int>(kPlanes);
  Eigen::Matrix<double, 3, n> normals;
  Eigen::Matrix<double, n, 1> gaps;
  for (int k = 0; k < n; ++k) {
    const HalfSpace& h = half_spaces[active[static_cast<std::size_t>(k)]];
    normals.col(k) = h.normal;
    gaps[k] = h.offset - h.normal.dot(point);
  }
  const Eigen::Matrix<double, n, n> gram = normals.transpose() * normals;
  if (gram.determinant() < kDependent * kDependent) return std::nullopt;
  const Eigen::Matrix<double, n, 1> multipliers = gram.inverse() * gaps;
  if (multipliers.minCoeff() < 0.0) return std::nullopt;
  const Eigen::Vector3d candidate = point + normals * multipliers;
  if (violation(half_spaces, candidate) > tolerance) return std::nullopt;
  return candidate;
}

}  // namespace

std::optional<Eigen::Vector3d> nearestPointIn(const std::vector<HalfSpace>& half_spaces,
                                              const Eigen::Vector3d& point, double tolerance) {
  if (violation(half_spaces, point) <= tolerance) return point;
  // There are few half-spaces, so all active sets of up to three planes are tried.
  const std::size_t count = half_spaces.size();
  std::optional<Eigen::Vector3d> found;
  for (std::size_t i = 0; i < count && !found; ++i) found = solution<1>(half_spaces, point, {i}, tolerance);
  for (std::size_t i = 0; i < count && !found; ++i) {
    for (std::size_t j = i + 1; j < count && !found; ++j) {
      found = solution<2>(half_spaces, point, {i, j}, tolerance);
      for (std::size_t k = j + 1; k < count && !found; ++k) {
        found = solution<3>(half_spaces, point, {i, j, k}, tolerance);
      }
    }
  }
  return found;
}

}  // namespace softbody
