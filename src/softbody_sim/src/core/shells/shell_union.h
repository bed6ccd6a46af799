#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "softbody_common/geometry/types.h"

namespace softbody {

/// The pairs of closed surfaces that cross or touch each other (CGAL).
std::vector<std::pair<std::size_t, std::size_t>> crossingPairs(const std::vector<TriangleMesh>& surfaces);

/// The surface around everything that a closed, outward surface or the other one encloses (corefinement,
/// CGAL). Nothing if one of them crosses itself or the result would not be a manifold.
std::optional<TriangleMesh> unionOf(const TriangleMesh& a, const TriangleMesh& b);

}  // namespace softbody
