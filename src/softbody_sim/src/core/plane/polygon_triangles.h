#pragma once

#include <array>
#include <vector>

#include "softbody_common/geometry/types.h"

namespace softbody {

/// A polygon's triangles, turned as the polygon.
struct PolygonTriangles {
  std::vector<std::array<int, 3>> triangles;  ///< indices of corners
  bool is_exact = true;  ///< false: a fan, because the polygon crosses itself or has no area
};

/// Triangulates a polygon of at least three corners, #C by 3. It may be concave, not quite flat, and touch
/// itself in corners and edges, as with a bridge to a hole. Where it begins does not matter.
PolygonTriangles polygonTriangles(const Points& corners);

}  // namespace softbody
