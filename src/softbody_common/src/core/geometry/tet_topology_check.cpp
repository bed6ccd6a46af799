#include "softbody_common/geometry/tet_topology_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <vector>

#include "softbody_common/geometry/tet_geometry.h"

namespace softbody {
namespace {

template <typename Elements>
void requireIndices(const Elements& elements, Eigen::Index vertex_count, const char* field) {
  for (Eigen::Index e = 0; e < elements.rows(); ++e) {
    for (Eigen::Index k = 0; k < elements.cols(); ++k) {
      const int vertex = elements(e, k);
      if (vertex < 0 || vertex >= vertex_count)
        throw std::invalid_argument(
            fmt::format("{}[{}] names vertex {} of {}", field, e, vertex, vertex_count));
      for (Eigen::Index j = 0; j < k; ++j) {
        if (elements(e, j) == vertex)
          throw std::invalid_argument(fmt::format("{}[{}] names vertex {} twice", field, e, vertex));
      }
    }
  }
}

void requireUsed(Eigen::Index vertex_count, const Tets& tets) {
  std::vector<bool> used(static_cast<std::size_t>(vertex_count), false);
  for (const int vertex : tets.reshaped()) used[static_cast<std::size_t>(vertex)] = true;
  const auto unused = std::find(used.begin(), used.end(), false);
  if (unused != used.end())
    throw std::invalid_argument(fmt::format("rest_vertices[{}] belongs to no tet", unused - used.begin()));
}

void requireVertices(const Points& vertices) {
  for (Eigen::Index v = 0; v < vertices.rows(); ++v) {
    if (!vertices.row(v).allFinite() || vertices.row(v).cwiseAbs().maxCoeff() > kFurthestRestPoint) {
      throw std::invalid_argument(
          fmt::format("rest_vertices[{}] is not finite, or beyond {} m", v, kFurthestRestPoint));
    }
  }
}

double squaredLongestEdge(const Points& vertices, const Eigen::RowVector4i& tet) {
  double longest = 0.0;
  for (int j = 0; j < 4; ++j) {
    for (int k = j + 1; k < 4; ++k)
      longest = std::max(longest, (vertices.row(tet[j]) - vertices.row(tet[k])).squaredNorm());
  }
  return longest;
}

/// Rounding to single precision can turn a sliver over: it moves each corner by a share of the coordinates.
void requireVolume(const Points& vertices, const Tets& tets) {
  const double rounding = 4.0 * std::numeric_limits<float>::epsilon() * vertices.cwiseAbs().maxCoeff();
  const Eigen::VectorXd volumes = tetVolumes(vertices, tets);
  for (Eigen::Index t = 0; t < tets.rows(); ++t) {
    if (volumes[t] < -rounding * squaredLongestEdge(vertices, tets.row(t)))
      throw std::invalid_argument(fmt::format("tets[{}] has the negative volume {} m^3", t, volumes[t]));
  }
  if (!(volumes.sum() > 0.0)) throw std::invalid_argument("the tets have no volume");
}

/// Pieces are numbered from 0, so there are at most as many as tets.
void requirePieces(const TetTopology& topology) {
  for (std::size_t t = 0; t < topology.tet_pieces.size(); ++t) {
    if (topology.tet_pieces[t] >= topology.tet_pieces.size())
      throw std::invalid_argument(
          fmt::format("tet_bodies[{}] is {}, above the number of tets", t, topology.tet_pieces[t]));
  }
}

}  // namespace

void requireWhole(const TetTopology& topology) {
  if (topology.tets.rows() == 0) throw std::invalid_argument("tets is empty; a body needs at least one");
  if (topology.surface.rows() == 0)
    throw std::invalid_argument("surface_triangles is empty; it must be the boundary of the tets");
  const Eigen::Index vertex_count = topology.rest_vertices.rows();
  requireIndices(topology.tets, vertex_count, "tets");
  requireIndices(topology.surface, vertex_count, "surface_triangles");
  requireUsed(vertex_count, topology.tets);
  requireVertices(topology.rest_vertices);
  requirePieces(topology);
  requireVolume(topology.rest_vertices, topology.tets);
  if (!isClosed(topology.surface))
    throw std::invalid_argument("surface_triangles is not closed; it must be the boundary of the tets");
}

bool sameRestBody(const TetTopology& a, const TetTopology& b) {
  using Single = Eigen::Matrix<float, Eigen::Dynamic, 3, Eigen::RowMajor>;
  if (a.rest_vertices.rows() != b.rest_vertices.rows() || a.tets.rows() != b.tets.rows() || a.tets != b.tets)
    return false;
  const Single of_a = a.rest_vertices.cast<float>(), of_b = b.rest_vertices.cast<float>();
  return of_a == of_b;
}

}  // namespace softbody
