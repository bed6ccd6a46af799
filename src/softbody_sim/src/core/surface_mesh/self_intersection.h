#pragma once

#include "softbody_common/types.h"

namespace softbody {

/// Whether two triangles of a mesh meet outside of their common vertices and edges (exact predicates, CGAL).
bool intersectsItself(const TriangleMesh& mesh);

}  // namespace softbody
