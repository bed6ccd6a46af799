#pragma once

#include <vector>

#include "cutting/patch/patch_facets.h"
#include "surface_mesh/half_edges.h"

namespace softbody {

/// A point of the curve: an edge of the mesh crosses the patch, or an edge of the patch pierces the mesh.
struct CurveNode {
  int mesh_edge = -1;   ///< the smaller half-edge of the crossed edge; -1: a patch edge pierces a triangle
  int patch_edge = -1;  ///< the piercing edge; -1: a mesh edge is crossed
  double along =
      0.0;  ///< position on the mesh edge, from the start of its half-edge, or on the patch edge, 0..1
  Eigen::Vector3d position;
};

/// A straight segment of the curve, in one triangle of the mesh and one facet. Seen from outside of the body,
/// the front of the patch is on its left. Seen from the front of the patch, the inside of the body is on its
/// left.
struct CurveSegment {
  int triangle = -1;
  int facet = -1;
  int from = -1, to = -1;  ///< nodes
};

/// The curve in which a mesh and a patch intersect.
struct CutCurve {
  std::vector<CurveNode> nodes;
  std::vector<CurveSegment> segments;
};

/// Computes the curve with exact predicates: both triangles at an edge agree on whether it is crossed. @throw
/// CutRefused if a vertex of one mesh lies exactly in the plane of a triangle of the other.
CutCurve intersect(const Points& vertices, const TriangleList& triangles, const std::vector<int>& mates,
                   const PatchFacets& facets);

}  // namespace softbody
