#pragma once

#include "forces/sparse_forces.h"
#include "forces/surface_places.h"
#include "softbody_sim/forces/force_estimate.h"

namespace softbody {

/// Joins forces whose places touch. @param vertices #V by 3 [m].
ForceEstimate patchesOf(const SparseForces& forces, const SurfacePlaces& places, const Points& vertices);

}  // namespace softbody
