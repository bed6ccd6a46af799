#pragma once

#include <vector>

#include "cutting/split/half_edges.h"
#include "softbody_common/types.h"

namespace softbody {

/// A closed mesh whose sheets share no vertex.
struct ManifoldMesh {
  TriangleList triangles;  ///< of the mesh; some refer to the copy of a vertex
  std::vector<int> mates;  ///< per half-edge
  std::vector<int>
      copied_from;  ///< per copy, its original; copies are numbered after the vertices of the mesh
};

/// Makes a mesh manifold by duplicating non-manifold vertices: sheets that touch in edges or vertices are
/// separated. At an edge with more than two triangles, two triangles with the body between them become
/// neighbours. @throw std::invalid_argument if an edge does not have the same number of triangles in both
/// directions.
ManifoldMesh splitNonManifold(const TriangleList& triangles, const Points& vertices);

}  // namespace softbody
