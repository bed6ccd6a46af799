#pragma once

#include <vector>

#include "softbody_common/geometry/types.h"

namespace softbody {

/// Vertices at which a triangle mesh is not a closed, consistently oriented 2-manifold: their triangles are
/// not one closed fan. Ascending. Vertices without triangles are ignored.
std::vector<int> nonManifoldVertices(const Triangles& triangles);

}  // namespace softbody
