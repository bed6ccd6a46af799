#pragma once

#include <vector>

#include "softbody_common/geometry/types.h"
#include "surface_mesh/half_edges.h"

namespace softbody {

/// A closed mesh whose sheets share no vertex.
struct ManifoldMesh {
  TriangleList triangles;  ///< of the mesh; some refer to the copy of a vertex
  std::vector<int> mates;  ///< per half-edge
  std::vector<int>
      copied_from;  ///< per copy, its original; copies are numbered after the vertices of the mesh
};

/// Per half-edge, its mate in the neighbouring triangle. At an edge with more than two triangles, two
/// triangles with the body between them are neighbours. -1: the edge does not have the same number of
/// triangles in both directions.
std::vector<int> matesAcrossBody(const TriangleList& triangles, const Points& vertices);

/// Makes a mesh manifold by duplicating non-manifold vertices: sheets that touch in edges or vertices are
/// separated. At an edge with more than two triangles, two triangles with the body between them become
/// neighbours. @throw std::invalid_argument if an edge does not have the same number of triangles in both
/// directions.
ManifoldMesh splitNonManifold(const TriangleList& triangles, const Points& vertices);

}  // namespace softbody
