#pragma once

#include <vector>

#include "softbody_common/geometry/types.h"

namespace softbody {

/// Binds every vertex of a surface to a tet, at rest. Both have the same cuts. The two walls of a slit are at
/// the same positions. A vertex of a wall is bound to the tets behind its wall, never to another piece of the
/// body.
/// @throw std::invalid_argument as TetLocator does.
std::vector<MaterialPoint> bindSurface(const MeshTopology& surface, const TetTopology& volume);

/// The same material points in an edited mesh, whose tets fill the same volume at rest. A point on the wall
/// of a slit stays on its side. A point in a tet that the edit does not change stays identical, bit by bit.
std::vector<MaterialPoint> transferPlaces(const std::vector<MaterialPoint>& places, const TetTopology& before,
                                          const TetTopology& after);

}  // namespace softbody
