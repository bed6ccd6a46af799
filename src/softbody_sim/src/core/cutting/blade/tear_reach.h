#pragma once

#include <vector>

#include "cutting/blade/tear_marks.h"

namespace softbody {

/// The stretch of every tet across a tear. A tet that is badly known is judged by what is known of the two
/// sides: how far they are apart there if both move on rigidly. Both estimates are weighted by their
/// precision. Without enough marks, the tet's own stretch holds.
std::vector<double> stretchAcross(const TetTopology& volume, const std::vector<TetStretch>& stretches,
                                  const RestPlane& plane, const std::vector<TearMark>& marks);

}  // namespace softbody
