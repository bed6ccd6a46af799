#pragma once

#include <vector>

#include "cutting/patch/patch_facets.h"
#include "cutting/split/half_edges.h"

namespace softbody {

/// Where an edge of the mesh crosses the patch, or an edge of the patch pierces the mesh.
struct CurveNode {
  int mesh_edge = -1;   ///< the smaller half-edge of the crossed edge; -1: a patch edge pierces a triangle
  int patch_edge = -1;  ///< the piercing edge; -1: a mesh edge is crossed
  double along =
      0.0;  ///< fraction of the way along the mesh edge, from its half-edge's start, or along the patch edge
  Eigen::Vector3d position;
};

/// A straight piece of the curve, in one triangle of the mesh and one facet. It runs so that, seen from
/// outside of the body, the front of the patch is on its left; seen from the patch's front, the inside of the
/// body is.
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

/// By exact predicates, so that every edge is crossed once or not at all whichever triangle asks.
/// @throw CutRefused if a vertex of one lies exactly in a triangle's plane of the other.
CutCurve intersect(const Points& vertices, const TriangleList& triangles, const std::vector<int>& mates,
                   const PatchFacets& facets);

}  // namespace softbody
