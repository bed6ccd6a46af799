#include "surface/strain.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "softbody_common/geometry/rigid_fit.h"
#include "softbody_common/geometry/tet_geometry.h"

namespace softbody {
namespace {

constexpr double kSmallestArea_m2 = 1e-14;

/// The largest |stretch - 1| of a deformation gradient, 3 by 2.
double largestStrain(const Eigen::Matrix<double, 3, 2>& gradient) {
  const Eigen::Matrix2d squared = gradient.transpose() * gradient;
  const double mean = 0.5 * squared.trace();
  const double spread = std::sqrt(std::max(0.0, mean * mean - squared.determinant()));
  const double most = std::sqrt(mean + spread), least = std::sqrt(std::max(0.0, mean - spread));
  return std::max(std::abs(most - 1.0), std::abs(least - 1.0));
}

Eigen::Matrix<double, 3, 2> edges(const Points& vertices, const Eigen::Vector3i& triangle) {
  Eigen::Matrix<double, 3, 2> result;
  for (int k = 0; k < 2; ++k)
    result.col(k) = (vertices.row(triangle[k + 1]) - vertices.row(triangle[0])).transpose();
  return result;
}

}  // namespace

SurfaceStrain::SurfaceStrain(const MeshTopology& topology)
    : triangles_(topology.triangles),
      inverse_rest_(static_cast<std::size_t>(triangles_.rows())),
      areas_(inverse_rest_.size(), 0.0),
      area_sums_(static_cast<std::size_t>(topology.rest_vertices.rows()), 0.0) {
  for (std::size_t t = 0; t < areas_.size(); ++t) {
    const Eigen::Vector3i triangle = triangles_.row(static_cast<Eigen::Index>(t));
    const Eigen::Matrix<double, 3, 2> rest = edges(topology.rest_vertices, triangle);
    const double area = 0.5 * Eigen::Vector3d(rest.col(0)).cross(Eigen::Vector3d(rest.col(1))).norm();
    if (area < kSmallestArea_m2) continue;  // its area stays 0: it does not count
    Eigen::Matrix<double, 3, 2> axes;
    axes.col(0) = rest.col(0).normalized();
    axes.col(1) = (rest.col(1) - axes.col(0).dot(rest.col(1)) * axes.col(0)).normalized();
    inverse_rest_[t] = (axes.transpose() * rest).inverse();
    areas_[t] = area;
    for (const int vertex : triangle) area_sums_[vertex] += area;
  }
}

std::vector<float> SurfaceStrain::at(const Points& vertices) const {
  std::vector<double> sums(area_sums_.size(), 0.0);
  for (std::size_t t = 0; t < areas_.size(); ++t) {
    if (areas_[t] == 0.0) continue;
    const Eigen::Vector3i triangle = triangles_.row(static_cast<Eigen::Index>(t));
    const double strain = largestStrain(edges(vertices, triangle) * inverse_rest_[t]);
    for (const int vertex : triangle) sums[vertex] += areas_[t] * strain;
  }
  std::vector<float> strains(sums.size(), 0.0f);
  for (std::size_t v = 0; v < sums.size(); ++v) {
    if (area_sums_[v] > 0.0) strains[v] = static_cast<float>(sums[v] / area_sums_[v]);
  }
  return strains;
}

std::vector<float> distancesFromRest(const MeshTopology& topology, const Points& vertices) {
  const auto pieces = vertexPieces(topology.triangles, topology.triangle_pieces, vertices.rows());
  std::vector<std::vector<int>> members(*std::max_element(pieces.begin(), pieces.end()) + 1);
  for (std::size_t v = 0; v < pieces.size(); ++v) members[pieces[v]].push_back(static_cast<int>(v));
  std::vector<float> distances(pieces.size(), 0.0f);
  for (const std::vector<int>& piece : members) {
    if (piece.empty()) continue;
    const Points rest = topology.rest_vertices(piece, Eigen::all), now = vertices(piece, Eigen::all);
    const Eigen::VectorXd distance = (transformed(rest, fitRigid(rest, now)) - now).rowwise().norm();
    for (std::size_t i = 0; i < piece.size(); ++i)
      distances[piece[i]] = static_cast<float>(distance[static_cast<Eigen::Index>(i)]);
  }
  return distances;
}

}  // namespace softbody
