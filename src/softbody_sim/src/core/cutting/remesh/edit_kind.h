#pragma once

#include "cutting/remesh/complex_edits.h"

namespace softbody {

/// Whether an edit keeps each sheet a surface, and each line a line.
bool keepsKind(const CutComplex& complex, const ComplexEdit& edit);

}  // namespace softbody
