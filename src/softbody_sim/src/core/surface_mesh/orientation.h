#pragma once

#include <vector>

#include "softbody_common/geometry/types.h"

namespace softbody {

/// Which triangles to flip so that neighbours agree. The majority of every patch that is connected across
/// edges with two triangles keeps its orientation.
std::vector<bool> trianglesToFlip(const Triangles& triangles);

}  // namespace softbody
