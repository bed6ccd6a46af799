#pragma once

#include <vector>

#include "cutting/remesh/complex_edits.h"

namespace softbody {

/// Makes an edit. The new triangles inherit lines, texture coordinates, sources and samples.
/// @return the new triangles.
std::vector<int> makeEdit(const ComplexEdit& edit, CutComplex* complex);

}  // namespace softbody
