#pragma once

#include <vector>

#include "softbody_common/types.h"

namespace softbody {

/// For every vertex the index of the first vertex within the tolerance (its own if there is none before).
std::vector<int> firstCoincident(const Points& vertices, double tolerance);

}  // namespace softbody
