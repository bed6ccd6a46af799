#pragma once

#include "softbody_common/types.h"

namespace softbody {

/// Tets of near uniform size inside a closed surface, whose boundary follows it (CGAL Mesh_3, Delaunay
/// refinement). The same input gives the same mesh. Slivers are removed as far as possible.
/// @param edge_length_m about the length of the boundary's edges.
/// @throw std::runtime_error if nothing comes out.
TetMesh meshInside(const TriangleMesh& surface, double edge_length_m);

}  // namespace softbody
