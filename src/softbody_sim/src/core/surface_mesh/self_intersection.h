#pragma once

#include <array>
#include <vector>

#include "softbody_common/geometry/types.h"

namespace softbody {

/// Whether two triangles of a mesh meet outside of their common vertices and edges, or more than two meet at
/// an edge (exact predicates, CGAL).
bool intersectsItself(const TriangleMesh& mesh);

/// The pairs of triangles that meet outside of their common vertices and edges. Empty if more than two
/// triangles meet at an edge.
std::vector<std::array<Eigen::Index, 2>> crossingTriangles(const TriangleMesh& mesh);

}  // namespace softbody
