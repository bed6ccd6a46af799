#pragma once

#include <vector>

#include "cutting/split/half_edges.h"
#include "softbody_common/types.h"

namespace softbody {

/// A closed mesh as sheets that share no vertex.
struct ManifoldMesh {
  TriangleList triangles;        ///< the mesh's, some with a copy instead of a vertex
  std::vector<int> mates;        ///< per half-edge
  std::vector<int> copied_from;  ///< per copy, numbered behind the mesh's vertices; none for a manifold
};

/// Parts sheets of a mesh that touch in edges or vertices only, so that each is a 2-manifold. Round an edge
/// with more than two triangles those are neighbours that have the body between them.
/// @throw std::invalid_argument if an edge does not have as many triangles to one side as to the other.
ManifoldMesh splitNonManifold(const TriangleList& triangles, const Points& vertices);

}  // namespace softbody
