#include "cutting/remesh/edit_shape.h"

#include <algorithm>

namespace softbody {
namespace {

bool counts(const ComplexTriangle& triangle, Judged judged) {
  return judged == Judged::kAll || triangle.sheet == Sheet::kSkin;
}

}  // namespace

double shapeBefore(const CutComplex& complex, const ComplexEdit& edit, Judged judged) {
  double least = 1.0;
  for (const int t : edit.removed) {
    if (counts(complex.triangles[t], judged)) least = std::min(least, complex.triangles[t].shape);
  }
  return least;
}

double shapeAfter(const CutComplex& complex, const ComplexEdit& edit, Judged judged, double limit) {
  const PlacesAfter at(complex, edit);
  double least = 1.0;
  for (const ComplexEdit::Added& added : edit.added) {
    if (!counts(complex.triangles[added.parent], judged)) continue;
    const auto& [a, b, c] = added.corners;
    least = std::min(least, sineOfLeastAngle(at(a), at(b), at(c)));
    if (least <= limit) return 0.0;
  }
  return least;
}

}  // namespace softbody
