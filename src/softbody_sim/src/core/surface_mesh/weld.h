#pragma once

#include <vector>

#include "softbody_common/geometry/types.h"

namespace softbody {

/// Per vertex, the index of the first vertex within the tolerance: its own index if no earlier vertex is.
std::vector<int> firstCoincident(const Points& vertices, double tolerance);

}  // namespace softbody
