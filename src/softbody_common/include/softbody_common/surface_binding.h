#pragma once

#include <vector>

#include "softbody_common/types.h"

namespace softbody {

/// A place in the tets for every vertex of a surface, both at rest and cut alike. Where a slit is, its two
/// walls lie at the same place: a vertex there is bound to the tets behind it, never to another piece of the
/// body.
/// @throw std::invalid_argument as TetLocator does.
std::vector<MaterialPoint> bindSurface(const MeshTopology& surface, const TetTopology& volume);

/// The same places in an edited mesh whose tets fill the same room at rest. A place on the wall of a slit
/// stays on its side; one inside of a tet that the edit leaves as it is stays the same, bit by bit.
std::vector<MaterialPoint> transferPlaces(const std::vector<MaterialPoint>& places, const TetTopology& before,
                                          const TetTopology& after);

}  // namespace softbody
