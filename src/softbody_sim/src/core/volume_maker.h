#pragma once

#include "softbody_common/types.h"

namespace softbody {

/// Tets whose boundary is a coarse, near uniform surface around all vertices of the mesh, which may have
/// holes.
/// @param cage_vertices about as many vertices has the boundary. @throw std::runtime_error if that fails.
TetMesh volumeAround(const TriangleMesh& visual, int cage_vertices);

/// Tets inside a closed cage, as fine as the cage, but not coarser than is fit for bending. Their boundary
/// follows the cage, pushed outward where a point to be enclosed would be left out. @throw std::runtime_error
/// if the cage cannot be filled.
TetMesh volumeInside(const TriangleMesh& cage, const Points& enclosed);

/// Area of a triangle mesh [m^2].
double areaOf(const TriangleMesh& mesh);

}  // namespace softbody
