#pragma once

#include <vector>

#include "cutting/surface/surface_cut.h"
#include "cutting/volume/tet_edit.h"

namespace softbody {

/// The places of the vertices of a cut visual mesh in the cut tets, each on its side of the cut.
///
/// The patch cannot tell the side, because the tets follow it only approximately. If at least half of a
/// vertex's weight is on corners off the crack, the vertex is on the side of its tet: crossings beyond the
/// middle of an edge snap to the other end. From these vertices the places spread along the cut mesh, by
/// walks through the cut tets. No walk leads to the other side. A connected piece of the mesh is placed in
/// one piece of the tets.
/// @param known per vertex of the mesh, its place in the earlier tets, on its side of all earlier cuts; tet
/// -1: unknown.
std::vector<MaterialPoint> placesByCutSide(const SurfaceCut& surface, const std::vector<MaterialPoint>& known,
                                           const TetTopology& before, const TetEdit& edit);

}  // namespace softbody
