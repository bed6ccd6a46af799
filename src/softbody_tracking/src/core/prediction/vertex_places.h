#pragma once

#include <vector>

#include "softbody_common/types.h"

namespace softbody {

/// A tet and corner weights that name each vertex of the volume.
std::vector<MaterialPoint> vertexPlaces(const TetTopology& volume);

}  // namespace softbody
