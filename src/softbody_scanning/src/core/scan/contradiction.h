#pragma once

#include "softbody_scanning/fusion/volume.h"

namespace softbody::scanning {

/// Part of the measured surface, 0..1, at places that many views measured and many others looked through:
/// something stood there for a part of the recording only. What passes through the view for a moment is
/// measured by few views, and does not count.
/// @param above_m height up to which the table's own surface is measured.
double contradictedShare(const Volume& volume, double above_m);

/// @throw std::invalid_argument if this part is too large: the object moved or changed its shape.
void requireOneSurface(const Volume& volume, double above_m);

}  // namespace softbody::scanning
