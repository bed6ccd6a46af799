#pragma once

#include "softbody_scanning/surface/distance_grid.h"

namespace softbody::scanning {

/// The surface where the distance is zero (dual contouring by OpenVDB). Its parts are closed, and their
/// triangles face outward. More than two triangles may meet at an edge.
TriangleMesh isoSurface(const DistanceGrid& grid);

}  // namespace softbody::scanning
