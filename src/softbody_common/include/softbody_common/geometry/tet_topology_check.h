#pragma once

#include "softbody_common/geometry/types.h"

namespace softbody {

/// Coordinates of a body at rest, and of cuts, are at most this far from its origin [m].
constexpr double kFurthestRestPoint = 1000.0;

/// @throw std::invalid_argument, with field and index, if a topology is not a body: it needs tets with volume
/// (rounding may leave flat ones), a closed surface, finite vertices within kFurthestRestPoint, and valid
/// indices.
void requireWhole(const TetTopology& topology);

/// Whether two topologies are the same as messages: rest vertices in single precision, and tets. Their
/// revisions may differ.
bool sameRestBody(const TetTopology& a, const TetTopology& b);

}  // namespace softbody
