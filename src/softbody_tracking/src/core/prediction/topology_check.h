#pragma once

#include "softbody_common/geometry/types.h"

namespace softbody {

/// Checks the body's models.
/// @throw std::invalid_argument if there is no tet, if a tet or triangle names a missing vertex, or if a list
/// for each triangle has another length.
void requireWhole(const TetTopology& volume, const MeshTopology& surface);

/// Whether a later topology can be an edit of the same body: most vertices that have a parent in both are at
/// the place at rest that they had, in single precision, as messages carry it: an edit rounds. Without such
/// vertices it can.
bool mayBeEditOf(const TetTopology& before, const TetTopology& after);
bool mayBeEditOf(const MeshTopology& before, const MeshTopology& after);

}  // namespace softbody
