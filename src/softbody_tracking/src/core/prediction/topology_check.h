#pragma once

#include "softbody_common/types.h"

namespace softbody {

/// @throw std::invalid_argument if a body has no tet, or a tet or a triangle, of the volume's boundary or of
/// the visual mesh, names a vertex that is not there, or not every triangle of the mesh has a body.
void requireWhole(const TetTopology& volume, const MeshTopology& surface);

}  // namespace softbody
