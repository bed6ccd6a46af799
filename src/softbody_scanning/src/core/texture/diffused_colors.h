#pragma once

#include <vector>

#include "softbody_common/geometry/types.h"

namespace softbody::scanning {

/// Colours of all vertices from those of some: each other vertex has the mean colour of its neighbours. A
/// piece of the surface without any known colour takes the mean of all known ones.
/// @param known #V. @param colors #V by 3, changed where not known.
void diffuseColors(const Triangles& triangles, const std::vector<bool>& known, Points* colors);

}  // namespace softbody::scanning
