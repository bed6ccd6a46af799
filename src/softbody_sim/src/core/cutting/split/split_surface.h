#pragma once

#include <vector>

#include "cutting/split/cut_curve.h"
#include "softbody_common/geometry/types.h"

namespace softbody {

/// A closed mesh with triangles divided along the curve of a cut, not yet opened: the curve is a set of its
/// half-edges. Unused vertices and triangles stay in the lists until compaction.
struct SplitSurface {
  std::vector<Eigen::Vector3d> vertices;  ///< vertices of the mesh, then new ones
  int own_vertices = 0;                   ///< number of vertices of the mesh
  TriangleList triangles;                 ///< corners -1: unused
  std::vector<int> sources;               ///< per triangle: the triangle of the mesh that contains it
  std::vector<int> mates;                 ///< per half-edge
  std::vector<Eigen::Vector2d> texture;   ///< per half-edge, at its start; or empty
  std::vector<int> curve;  ///< per half-edge: the facet if the curve runs along it and its triangle is on the
                           ///< front side of the patch; else -1
  std::vector<int> changed;        ///< new triangles
  std::vector<int> node_vertices;  ///< per node of the curve

  bool used(int triangle) const { return triangles[triangle][0] >= 0; }
};

/// Whether texture coordinates at one vertex are the same, up to rounding: no seam is between them.
bool sameTexture(const Eigen::Vector2d& a, const Eigen::Vector2d& b);

/// The half-edges that the curve runs along, ascending.
std::vector<int> halfEdgesOfCurve(const SplitSurface& surface);

/// Divides each triangle that the curve crosses, by constrained Delaunay triangulation.
/// @throw CutRefused if segments of the curve cross each other.
SplitSurface splitAlong(const CutCurve& curve, const MeshTopology& mesh, TriangleList triangles,
                        const std::vector<int>& mates);

}  // namespace softbody
