#pragma once

#include "cutting/remesh/complex_edits.h"

namespace softbody {

/// The triangles of which the shape counts.
enum class Judged { kSkin, kAll };

/// Sine of the least angle of the triangles that an edit removes. 1 if it removes none of those that count.
double shapeBefore(const CutComplex& complex, const ComplexEdit& edit, Judged judged);

/// The same of the triangles that it adds; 0 if it is not above a limit.
double shapeAfter(const CutComplex& complex, const ComplexEdit& edit, Judged judged, double limit);

}  // namespace softbody
