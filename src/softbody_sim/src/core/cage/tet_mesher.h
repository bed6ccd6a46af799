#pragma once

#include "softbody_common/geometry/types.h"

namespace softbody {

/// Fills a closed surface with tets (constrained Delaunay refinement, TetGen in a process of prepare_model).
/// The same input gives the same mesh.
/// @param edge_length_m the largest tet has twice the volume of a regular tet with this edge length.
/// @param keep_surface the boundary keeps the triangles of the surface; otherwise they may be split.
/// @throw std::runtime_error if the surface intersects itself or TetGen makes no tet; std::system_error if
/// prepare_model cannot be started or does not end.
TetMesh meshInside(const TriangleMesh& surface, double edge_length_m, bool keep_surface);

}  // namespace softbody
