#pragma once

#include "softbody_common/types.h"

namespace softbody {

/// A closed, oriented 2-manifold that encloses every triangle at about the offset (Portaneri et al. 2022,
/// "Alpha Wrapping with an Offset"). Holes and gaps narrower than alpha are closed.
TriangleMesh alphaWrap(const TriangleMesh& mesh, double alpha_m, double offset_m);

}  // namespace softbody
