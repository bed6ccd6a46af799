#pragma once

#include <vector>

#include "softbody_common/types.h"

namespace softbody {

/// Vertices at which a triangle mesh is no closed, consistently oriented 2-manifold: their triangles are not
/// one closed fan. Ascending; empty for a mesh that is one everywhere. Vertices without triangles pass.
std::vector<int> nonManifoldVertices(const Triangles& triangles);

}  // namespace softbody
