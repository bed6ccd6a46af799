#pragma once

#include <Eigen/Core>
#include <vector>

#include "softbody_common/geometry/types.h"

namespace softbody {

/// Signed volume of every tet [m^3], #T.
Eigen::VectorXd tetVolumes(const Points& vertices, const Tets& tets);

/// Volume enclosed by a closed, outward triangle mesh [m^3] (divergence theorem).
double enclosedVolume(const Points& vertices, const Triangles& triangles);

/// The triangles that belong to exactly one tet, outward. The tets must have positive volume.
Triangles boundaryTriangles(const Tets& tets);

/// Whether the triangles have no boundary: every edge is used equally often in both directions.
bool isClosed(const Triangles& triangles);

/// The connected piece of every tet, numbered from 0 in order of appearance. Tets that share a vertex are
/// connected.
std::vector<std::uint32_t> tetPieces(const Tets& tets, int vertex_count);

/// The connected piece of every triangle, numbered from 0 in order of appearance.
std::vector<std::uint32_t> trianglePieces(const Triangles& triangles, int vertex_count);

/// The connected piece of every vertex, from the pieces of the elements (tets or triangles) around it.
template <typename Elements>
std::vector<std::uint32_t> vertexPieces(const Elements& elements, const std::vector<std::uint32_t>& pieces,
                                        Eigen::Index vertex_count) {
  std::vector<std::uint32_t> result(static_cast<std::size_t>(vertex_count), 0);
  for (Eigen::Index e = 0; e < elements.rows(); ++e) {
    for (Eigen::Index k = 0; k < elements.cols(); ++k) result[elements(e, k)] = pieces[e];
  }
  return result;
}

/// The vertices of every connected piece of the tets.
std::vector<std::vector<int>> verticesOfPieces(const Tets& tets, Eigen::Index vertex_count);

/// Unit normals, the area-weighted mean of the adjacent triangles, #V by 3. Zero for a vertex without
/// triangles.
Points vertexNormals(const Points& vertices, const Triangles& triangles);

/// Barycentric coordinates of a point in a tet; they sum to 1, also for points outside of the tet.
/// @throw std::invalid_argument if the tet has no volume.
Eigen::Vector4d barycentricCoordinates(const Eigen::Vector3d& point, const Points& vertices,
                                       const Eigen::Vector4i& tet);

/// Position of a material point for the given vertices [m].
inline Eigen::Vector3d positionOf(const MaterialPoint& place, const Points& vertices, const Tets& tets) {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  for (int k = 0; k < 4; ++k) {
    position += place.barycentric[k] * vertices.row(tets(place.tet, k)).transpose();
  }
  return position;
}

/// Mean length of the tets' edges [m].
double meanEdgeLength(const Points& vertices, const Tets& tets);

/// The point of the triangle (a, b, c) nearest to p.
Eigen::Vector3d nearestOnTriangle(const Eigen::Vector3d& p, const Eigen::Vector3d& a,
                                  const Eigen::Vector3d& b, const Eigen::Vector3d& c);

/// Barycentric coordinates of a point p of the triangle (a, b, c): areas opposite to the corners, sum 1. A
/// third each if the triangle has no area.
Eigen::Vector3d cornerWeights(const Eigen::Vector3d& p, const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                              const Eigen::Vector3d& c);

}  // namespace softbody
