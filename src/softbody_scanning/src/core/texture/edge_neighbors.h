#pragma once

#include <array>
#include <vector>

#include "softbody_common/geometry/types.h"

namespace softbody::scanning {

/// Per triangle: the triangle beyond the side from corner k to corner k + 1; -1: none.
using EdgeNeighbors = std::vector<std::array<int, 3>>;

/// A side of more than two triangles joins the first two.
EdgeNeighbors edgeNeighbors(const Triangles& triangles);

}  // namespace softbody::scanning
