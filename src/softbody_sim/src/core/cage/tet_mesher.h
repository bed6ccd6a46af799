#pragma once

#include "softbody_common/types.h"

namespace softbody {

/// Tets inside a closed surface, whose boundary is that surface (constrained Delaunay refinement, TetGen).
/// The same input gives the same mesh.
/// @param edge_length_m of a regular tet half as large as the largest allowed.
/// @param keep_surface the boundary has the surface's very triangles; otherwise they may be split.
/// @throw std::runtime_error if the surface intersects itself or nothing comes out.
TetMesh meshInside(const TriangleMesh& surface, double edge_length_m, bool keep_surface);

}  // namespace softbody
