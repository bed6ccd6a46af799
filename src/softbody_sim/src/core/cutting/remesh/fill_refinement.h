#pragma once

#include "cutting/remesh/cut_complex.h"

namespace softbody {

/// Puts vertices into the fill, which has none inside: its longest edges are split until the triangles
/// inside are little larger than those at the border.
/// @param distance of the result from the surface, at most [m].
void refineFill(double distance, CutComplex* complex);

}  // namespace softbody
