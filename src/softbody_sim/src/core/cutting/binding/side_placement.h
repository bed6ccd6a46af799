#pragma once

#include <vector>

#include "cutting/surface/surface_cut.h"
#include "cutting/volume/tet_edit.h"

namespace softbody {

/// Places of a cut visual mesh's vertices in the cut tets, each on its own side of the cut.
///
/// Which side is not asked of the patch: the tets follow it only roughly. A vertex with half of its weight or
/// more on corners off the crack is on the side of its tet, since crossings beyond the middle of an edge
/// belong to the other end. From these the places spread along the mesh, which is cut, by walks through the
/// tets, which are cut: no way leads to the other side. A connected piece of the mesh is placed in one piece
/// of the tets.
/// @param known per vertex of the mesh its place in the tets before, on its side of all earlier cuts; tet -1:
/// none.
std::vector<MaterialPoint> placesByCutSide(const SurfaceCut& surface, const std::vector<MaterialPoint>& known,
                                           const TetTopology& before, const TetEdit& edit);

}  // namespace softbody
