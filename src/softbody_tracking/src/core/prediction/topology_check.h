#pragma once

#include "softbody_common/types.h"

namespace softbody {

/// Checks the body's models.
/// @throw std::invalid_argument if there is no tet, if a tet or triangle names a missing vertex, or if a list
/// for each triangle has another length.
void requireWhole(const TetTopology& volume, const MeshTopology& surface);

}  // namespace softbody
