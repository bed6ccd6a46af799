#pragma once

#include "softbody_common/geometry/types.h"

namespace softbody::scanning {

/// The same surface in triangles of nearly one size (Botsch and Kobbelt 2004, by CGAL), and a manifold.
/// @throw std::invalid_argument if the mesh encloses nothing.
TriangleMesh remeshed(const TriangleMesh& mesh, double edge_m);

}  // namespace softbody::scanning
