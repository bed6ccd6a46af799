#pragma once

#include <vector>

#include "cutting/remesh/complex_edits.h"

namespace softbody {

/// Whether the complex stays near to what it was before remeshing, and no triangle turns over: the places of
/// removed vertices and the middles of their edges, kept as samples, are near to the surface, and those of
/// lines near to the lines.
/// @param distance at most [m].
bool staysNear(const CutComplex& complex, const ComplexEdit& edit, double distance);

/// Gives the samples of removed triangles and lines to the nearest new ones.
void passOnSamples(const ComplexEdit& edit, CutComplex* complex, std::vector<ComplexTriangle>* made);

}  // namespace softbody
