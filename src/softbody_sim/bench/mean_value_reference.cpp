#include "bench/mean_value_reference.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <type_traits>
#include <vector>

namespace softbody::bench {
namespace {

template <typename Scalar>
constexpr Scalar kPi = 3.141592653589793238462643383279502884L;
template <typename Scalar>
constexpr Scalar kEpsilon = std::is_same_v<Scalar, double> ? 1e-8 : 1e-13;
template <typename Scalar>
using Vector3 = Eigen::Matrix<Scalar, 3, 1>;
template <typename Scalar>
using Row = Eigen::Matrix<Scalar, 1, Eigen::Dynamic>;

template <typename Scalar>
struct Corners {
  Vector3<Scalar> direction[3];
  Scalar distance[3];
};

/// Computes one triangle's weights. @return true if the point lies on the triangle; then other triangles have
/// no weight.
template <typename Scalar>
bool triangleWeights(const Corners<Scalar>& t, Scalar (&weights)[3]) {
  using std::abs, std::asin, std::sin, std::sqrt;
  Scalar theta[3], c[3], s[3];
  for (int i = 0; i < 3; ++i) {
    theta[i] = 2 * asin((t.direction[(i + 1) % 3] - t.direction[(i + 2) % 3]).norm() / 2);
  }
  const Scalar h = (theta[0] + theta[1] + theta[2]) / 2;
  if (kPi<Scalar> - h < kEpsilon<Scalar>) {
    for (int i = 0; i < 3; ++i) {
      weights[i] = sin(theta[i]) * t.distance[(i + 1) % 3] * t.distance[(i + 2) % 3];
    }
    return true;
  }
  const Scalar sign = t.direction[0].cross(t.direction[1]).dot(t.direction[2]) < 0 ? -1 : 1;
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    c[i] = 2 * sin(h) * sin(h - theta[i]) / (sin(theta[j]) * sin(theta[k])) - 1;
    s[i] = sign * sqrt(std::max<Scalar>(0, 1 - c[i] * c[i]));
    weights[i] = 0;
  }
  if (std::any_of(s, s + 3, [](Scalar value) { return abs(value) <= kEpsilon<Scalar>; })) return false;
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    weights[i] = (theta[i] - c[j] * theta[k] - c[k] * theta[j]) / (t.distance[i] * sin(theta[j]) * s[k]);
  }
  return false;
}

template <typename Scalar>
Row<Scalar> pointWeights(const Eigen::Vector3d& point, const Points& cage, const Triangles& triangles) {
  std::vector<Vector3<Scalar>> directions(static_cast<std::size_t>(cage.rows()));
  std::vector<Scalar> distances(directions.size());
  for (std::size_t v = 0; v < directions.size(); ++v) {
    const auto row = static_cast<Eigen::Index>(v);
    const Vector3<Scalar> offset = cage.row(row).transpose().cast<Scalar>() - point.cast<Scalar>();
    distances[v] = offset.norm();
    if (distances[v] < kEpsilon<Scalar>) return Row<Scalar>::Unit(cage.rows(), row);
    directions[v] = offset / distances[v];
  }
  Row<Scalar> sums = Row<Scalar>::Zero(cage.rows());
  for (Eigen::Index f = 0; f < triangles.rows(); ++f) {
    Corners<Scalar> corners;
    for (int k = 0; k < 3; ++k) {
      corners.direction[k] = directions[static_cast<std::size_t>(triangles(f, k))];
      corners.distance[k] = distances[static_cast<std::size_t>(triangles(f, k))];
    }
    Scalar weights[3];
    const bool is_on = triangleWeights(corners, weights);
    if (is_on) sums.setZero();
    for (int k = 0; k < 3; ++k) sums[triangles(f, k)] += weights[k];
    if (is_on) break;
  }
  return sums / sums.sum();
}

}  // namespace

template <typename Scalar>
void referenceMeanValueCoordinates(const Points& points, const Points& cage_vertices,
                                   const Triangles& cage_triangles, WeightRows* weights) {
  weights->resize(points.rows(), cage_vertices.rows());
  for (Eigen::Index p = 0; p < points.rows(); ++p) {
    weights->row(p) =
        pointWeights<Scalar>(points.row(p), cage_vertices, cage_triangles).template cast<double>();
  }
}

template void referenceMeanValueCoordinates<double>(const Points&, const Points&, const Triangles&,
                                                    WeightRows*);
template void referenceMeanValueCoordinates<long double>(const Points&, const Points&, const Triangles&,
                                                         WeightRows*);

}  // namespace softbody::bench
