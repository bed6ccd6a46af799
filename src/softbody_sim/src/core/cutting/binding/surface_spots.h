#pragma once

#include <vector>

#include "softbody_common/geometry/types.h"

namespace softbody {

/// Moves vertices with a surface on which they lie at rest. Vertices that are further from it than 1/1000 of
/// its diagonal keep their positions. Of two triangles beside a slit, the one nearest to the given position
/// is taken.
/// @param surface at rest; @param shown its vertices in another state.
/// @param which vertices; @param rest their places, and @param positions those in the other state, per
/// vertex.
void moveWithSurface(const MeshTopology& surface, const Points& shown, const std::vector<int>& which,
                     const Points& rest, Points* positions);

}  // namespace softbody
