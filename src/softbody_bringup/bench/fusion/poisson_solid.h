#pragma once

#include "bench/fusion/oriented_points.h"
#include "softbody_scanning/surface/distance_grid.h"

namespace softbody::scanning {

/// Poisson surface reconstruction (Kazhdan et al. 2006, by CGAL on a Delaunay triangulation): its function at
/// the grid points of a box, divided by its slope at the surface, so that it is nearly a distance there [m].
/// @throw std::runtime_error if the linear system cannot be solved.
DistanceGrid poissonSolid(const OrientedPoints& points, const FusionBox& box);

}  // namespace softbody::scanning
