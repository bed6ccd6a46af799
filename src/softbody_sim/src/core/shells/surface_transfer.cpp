#include "shells/surface_transfer.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <boost/functional/hash.hpp>
#include <map>
#include <numeric>
#include <unordered_map>

#include "softbody_sim/surface_mesh/closest_point.h"

namespace softbody {
namespace {

using Place = std::array<double, 3>;

Place placeOf(const Points& points, Eigen::Index v) { return {points(v, 0), points(v, 1), points(v, 2)}; }

/// Per vertex of the new mesh, the old vertex at the same place, or -1.
std::vector<int> oldVertices(const Points& before, const Points& after) {
  std::unordered_map<Place, int, boost::hash<Place>> places;
  for (Eigen::Index v = 0; v < before.rows(); ++v) places.emplace(placeOf(before, v), static_cast<int>(v));
  std::vector<int> old(static_cast<std::size_t>(after.rows()), -1);
  for (Eigen::Index v = 0; v < after.rows(); ++v) {
    const auto found = places.find(placeOf(after, v));
    if (found != places.end()) old[static_cast<std::size_t>(v)] = found->second;
  }
  return old;
}

/// Texture of a point in the plane of a triangle, also beside it.
Eigen::RowVector3d textureAt(const WeldedSurface& surface, Eigen::Index f, const Eigen::RowVector3d& point) {
  const auto corner = [&](int k) { return surface.mesh.vertices.row(surface.mesh.triangles(f, k)); };
  Eigen::Matrix<double, 3, 2> edges;
  edges << (corner(1) - corner(0)).transpose(), (corner(2) - corner(0)).transpose();
  const Eigen::Vector2d along = edges.colPivHouseholderQr().solve((point - corner(0)).transpose());
  const auto texture = [&](int k) { return surface.texture_coordinates.row(3 * f + k); };
  return texture(0) + along[0] * (texture(1) - texture(0)) + along[1] * (texture(2) - texture(0));
}

Points transferredTexture(const WeldedSurface& from, const TriangleMesh& to) {
  const ClosestPointQuery query(from.mesh.vertices, from.mesh.triangles);
  Points texture(3 * to.triangles.rows(), 3);
  for (Eigen::Index f = 0; f < to.triangles.rows(); ++f) {
    const Eigen::RowVector3i t = to.triangles.row(f);
    const Eigen::Vector3d middle =
        (to.vertices.row(t[0]) + to.vertices.row(t[1]) + to.vertices.row(t[2])) / 3.0;
    const Eigen::Index nearest = query.closest(middle).triangle;
    for (int k = 0; k < 3; ++k) texture.row(3 * f + k) = textureAt(from, nearest, to.vertices.row(t[k]));
  }
  return texture;
}

}  // namespace

WeldedSurface transferred(const WeldedSurface& from, const TriangleMesh& to) {
  const std::vector<int> old = oldVertices(from.mesh.vertices, to.vertices);
  std::vector<int> order(old.size()), position(old.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&old](int a, int b) {
    return static_cast<unsigned>(old[static_cast<std::size_t>(a)]) <
           static_cast<unsigned>(old[static_cast<std::size_t>(b)]);  // -1 comes last
  });
  WeldedSurface result;
  for (std::size_t k = 0; k < order.size(); ++k) {
    const auto v = static_cast<std::size_t>(order[k]);
    position[v] = static_cast<int>(k);
    result.vertex_parents.push_back(old[v] < 0 ? -1 : from.vertex_parents[static_cast<std::size_t>(old[v])]);
  }
  result.mesh.vertices = to.vertices(order, Eigen::all);
  result.mesh.triangles =
      to.triangles.unaryExpr([&position](int v) { return position[static_cast<std::size_t>(v)]; });
  if (from.texture_coordinates.rows() > 0) result.texture_coordinates = transferredTexture(from, result.mesh);
  return result;
}

}  // namespace softbody
