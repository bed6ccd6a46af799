#pragma once

#include "softbody_scanning/surface/distance_grid.h"

namespace softbody::scanning {

/// Continues the surface into space that no view saw into, between legs or under a belly: there the signed
/// distance is harmonic, with the measured distances at its border (volumetric diffusion, Davis et al. 2002).
/// Nothing flows through the border of the grid: what it cuts off goes on beyond it.
/// @param unknown #grid points. @param grid changes only there.
void fillUnknown(const std::vector<bool>& unknown, DistanceGrid* grid);

}  // namespace softbody::scanning
