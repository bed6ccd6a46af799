#pragma once

#include "softbody_common/geometry/types.h"

namespace softbody {

/// A closed, oriented 2-manifold around all triangles, at about the offset from them (Portaneri et al. 2022,
/// "Alpha Wrapping with an Offset"). Closes holes and gaps narrower than alpha.
TriangleMesh alphaWrap(const TriangleMesh& mesh, double alpha_m, double offset_m);

}  // namespace softbody
