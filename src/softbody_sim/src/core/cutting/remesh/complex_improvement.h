#pragma once

#include "cutting/remesh/cut_complex.h"

namespace softbody {

/// Edits the worst triangles of the skin first, as long as the least angle around an edit becomes larger. The
/// shape of the fill does not count.
/// @param goal sine of the angle above which a triangle is left as it is.
/// @param distance of the result from the surface, at most [m].
void improveSkin(double goal, double distance, CutComplex* complex);

/// The same for the fill. Where an edit changes the skin as well, its shape counts, too.
void improveFill(double goal, double distance, CutComplex* complex);

}  // namespace softbody
