#pragma once

#include <vector>

#include "softbody_common/geometry/types.h"

namespace softbody::bench {

/// The tracker's kind of input: the body bends to and fro once, under 1500 depth targets with normals on its
/// upper side. Their places change in every frame. The first set places the body.
std::vector<TargetSet> bendingTargets(const TetTopology& body, int frames);

}  // namespace softbody::bench
