#pragma once

#include <vector>

#include "softbody_common/types.h"

namespace softbody {

/// Whether two triangles of a mesh meet outside of their common vertices and edges, or more than two meet at
/// an edge (exact predicates, CGAL).
bool intersectsItself(const TriangleMesh& mesh);

/// One triangle of each pair that meets outside of its common vertices and edges. Empty if more than two
/// triangles meet at an edge.
std::vector<Eigen::Index> crossingTriangles(const TriangleMesh& mesh);

}  // namespace softbody
