#pragma once

#include <functional>

#include "softbody_common/types.h"

namespace softbody {

/// Tets whose boundary is a coarse, near uniform surface around all vertices of the mesh, which may have
/// holes, several shells or intersect itself.
/// @param cage_vertices about as many vertices has the boundary; more where its shape does not let it be so
/// coarse. 0: as many as suit its shape. @param progress is told the share that is done (0..1).
/// @throw std::runtime_error if that fails.
TetMesh volumeAround(
    const TriangleMesh& visual, int cage_vertices,
    const std::function<void(double)>& progress = [](double) {});

/// Tets inside a closed cage, as fine as the cage, but not coarser than is fit for bending. Their boundary is
/// the cage, its triangles split where they are too coarse.
/// @throw std::runtime_error if the cage cannot be filled.
TetMesh volumeInside(const TriangleMesh& cage);

/// Area of a triangle mesh [m^2].
double areaOf(const TriangleMesh& mesh);

}  // namespace softbody
