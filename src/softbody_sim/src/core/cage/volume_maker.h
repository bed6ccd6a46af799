#pragma once

#include <functional>

#include "softbody_common/geometry/types.h"

namespace softbody {

/// Tets whose boundary is a coarse, nearly uniform surface around all vertices of a mesh. The mesh may have
/// several shells and self-intersections.
/// @param cage_vertices approximate number of vertices of the boundary; a complex shape needs more. 0: chosen
/// from the shape. @param progress called with the finished fraction, 0..1.
/// @throw std::runtime_error if no tets can be made.
TetMesh volumeAround(
    const TriangleMesh& visual, int cage_vertices,
    const std::function<void(double)>& progress = [](double) {});

/// Fills a closed cage with tets of the size of its triangles. The triangles of a coarse cage are split,
/// because otherwise it could not bend.
/// @throw std::runtime_error if the cage cannot be filled.
TetMesh volumeInside(const TriangleMesh& cage);

/// Area of a triangle mesh [m^2].
double areaOf(const TriangleMesh& mesh);

}  // namespace softbody
