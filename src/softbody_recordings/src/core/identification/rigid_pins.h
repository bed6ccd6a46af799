#pragma once

#include <vector>

#include "identification/seen_frame.h"

namespace softbody {

/// Pins of each frame that hold their vertices as at rest, so that the tracker's noise does not bend what
/// they hold. Where a region holds the body is the median over the frames in which the whole body is near its
/// rest shape, or else over all, by the region's own vertices.
/// @param frames in which the same vertices are held by a region of a name. @param rest #V by 3 [m].
/// @param noticeable_m rms distance from the rest shape that counts as near.
std::vector<std::vector<Pin>> rigidPins(const std::vector<SeenFrame>& frames, const Points& rest,
                                        double noticeable_m);

}  // namespace softbody
