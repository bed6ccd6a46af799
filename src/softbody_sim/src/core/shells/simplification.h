#pragma once

#include "softbody_common/geometry/types.h"

namespace softbody {

/// The mesh with about this number of triangles: edges collapse where that changes the shape least, with the
/// volume kept (Lindstrom and Turk 1998, CGAL). @throw std::invalid_argument if more than two triangles meet
/// at an edge.
TriangleMesh simplified(const TriangleMesh& mesh, int triangles);

}  // namespace softbody
