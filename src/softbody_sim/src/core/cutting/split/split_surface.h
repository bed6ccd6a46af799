#pragma once

#include <vector>

#include "cutting/split/cut_curve.h"
#include "softbody_common/types.h"

namespace softbody {

/// A closed mesh whose triangles are divided along a cut's curve, still uncut: the curve is a set of its
/// half-edges. Vertices and triangles that are no longer used stay in the lists until the end.
struct SplitSurface {
  std::vector<Eigen::Vector3d> vertices;  ///< the mesh's own, then new ones
  int own_vertices = 0;                   ///< number of the mesh's own
  TriangleList triangles;                 ///< corners -1: no longer used
  std::vector<int> sources;               ///< per triangle: the mesh's triangle that it is a part of
  std::vector<int> mates;                 ///< per half-edge
  std::vector<Eigen::Vector2d> texture;   ///< per half-edge, of its start; or empty
  std::vector<int> curve;  ///< per half-edge: the facet if the curve runs along it, with the patch's front on
                           ///< its triangle's side; else -1
  std::vector<int> changed;        ///< triangles that are not the mesh's own
  std::vector<int> node_vertices;  ///< per node of the curve

  bool used(int triangle) const { return triangles[triangle][0] >= 0; }
};

/// The half-edges that the curve runs along, ascending.
std::vector<int> halfEdgesOfCurve(const SplitSurface& surface);

/// Divides each triangle that the curve passes by constrained Delaunay triangulation.
/// @throw CutRefused if pieces of the curve cross each other.
SplitSurface splitAlong(const CutCurve& curve, const MeshTopology& mesh, TriangleList triangles,
                        const std::vector<int>& mates);

}  // namespace softbody
