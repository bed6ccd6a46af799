#include "surface_mesh/closest_surface_point.h"

#include <fmt/format.h>

#include <limits>
#include <stdexcept>

#include "softbody_common/geometry/tet_geometry.h"

namespace softbody {
namespace {

struct Corners {
  Eigen::Vector3d a, b, c;
};

Corners cornersOf(const MeshTopology& topology, const Points& vertices, Eigen::Index triangle) {
  const auto corner = [&](int k) { return Eigen::Vector3d(vertices.row(topology.triangles(triangle, k))); };
  return {corner(0), corner(1), corner(2)};
}

void requireFit(const MeshTopology& topology, const MeshState& state) {
  if (topology.triangles.rows() == 0) throw std::invalid_argument("the surface has no triangle");
  if (state.revision == topology.revision && state.vertices.rows() == topology.rest_vertices.rows()) return;
  throw std::invalid_argument(
      fmt::format("the state is of revision {} with {} vertices, the topology of revision {} with {}",
                  state.revision, state.vertices.rows(), topology.revision, topology.rest_vertices.rows()));
}

}  // namespace

ClosestSurfacePoint closestSurfacePoint(const MeshTopology& topology, const MeshState& state,
                                        const Eigen::Vector3d& point) {
  requireFit(topology, state);
  ClosestSurfacePoint closest;
  double least = std::numeric_limits<double>::infinity();
  for (Eigen::Index f = 0; f < topology.triangles.rows(); ++f) {
    const Corners t = cornersOf(topology, state.vertices, f);
    const Eigen::Vector3d nearest = nearestOnTriangle(point, t.a, t.b, t.c);
    const double distance = (nearest - point).squaredNorm();
    if (!(distance < least)) continue;
    least = distance;
    closest.triangle = static_cast<int>(f);
    closest.position = nearest;
  }
  const Corners t = cornersOf(topology, state.vertices, closest.triangle);
  closest.piece = topology.triangle_pieces[static_cast<std::size_t>(closest.triangle)];
  closest.normal = (t.b - t.a).cross(t.c - t.a).normalized();
  const Eigen::Vector3d weights = cornerWeights(closest.position, t.a, t.b, t.c);
  const auto interpolate = [&](const std::vector<float>& values) {
    double sum = 0.0;
    for (int k = 0; k < 3; ++k)
      sum += weights[k] * values[static_cast<std::size_t>(topology.triangles(closest.triangle, k))];
    return static_cast<float>(sum);
  };
  closest.confidence = interpolate(state.confidence);
  closest.standard_deviation = state.standard_deviation.empty() ? std::numeric_limits<float>::quiet_NaN()
                                                                : interpolate(state.standard_deviation);
  return closest;
}

}  // namespace softbody
