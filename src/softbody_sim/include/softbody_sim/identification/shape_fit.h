#pragma once

#include <functional>
#include <vector>

#include "softbody_sim/identification/material_estimate.h"

namespace softbody {

/// Finds the material from one measured shape: the simulated surface in balance has to go through the
/// measured points, up to a rigid motion. The points are compared by their distances to the surface, and
/// where each belongs is looked up again until nothing changes. @param problem with one observation, without
/// targets. Its deviations are scaled to what the points show. @param visual the body's surface at rest.
/// @param measured points on the deformed surface [m], turned and shifted from the rest shape so little that
/// its sides are not confused. @param targets if not null, gets where the points belong at the end. @throw
/// std::invalid_argument as identifyMaterial, or if there are too few points or they are far away.
MaterialEstimate identifyFromShape(
    MaterialProblem problem, const MeshTopology& visual, const Points& measured,
    const std::function<void(double)>& progress = [](double) {}, std::vector<Target>* targets = nullptr);

}  // namespace softbody
