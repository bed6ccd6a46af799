#pragma once

#include <vector>

#include "softbody_common/geometry/types.h"

namespace softbody {

/// Each vertex of the volume as a material point: one of its tets and the weight 1 at its corner.
std::vector<MaterialPoint> vertexPlaces(const TetTopology& volume);

}  // namespace softbody
