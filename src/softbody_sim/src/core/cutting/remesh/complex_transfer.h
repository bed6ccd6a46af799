#pragma once

#include "cutting/fill/cut_fill.h"
#include "cutting/remesh/cut_complex.h"
#include "cutting/split/split_surface.h"

namespace softbody {

/// The fill and the skin around the curve. Vertices up to one edge away from the curve may leave. The faces
/// of earlier cuts are left out together with all edits that would change them: the two walls of an earlier
/// cut stay mirror images.
/// @param is_cut per triangle of the mesh: it fills an earlier cut.
CutComplex complexAround(const SplitSurface& surface, const CutFill& fill, const std::vector<bool>& is_cut);

/// Replaces the skin and the fill by those of a complex that was made from them.
/// @throw CutRefused if the new fill does not reach the whole curve.
void writeBack(const CutComplex& complex, SplitSurface* surface, CutFill* fill);

}  // namespace softbody
