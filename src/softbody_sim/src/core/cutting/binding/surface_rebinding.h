#pragma once

#include <vector>

#include "cutting/surface/surface_cut.h"
#include "cutting/volume/tet_edit.h"
#include "softbody_sim/interpolation/visual_surface.h"

namespace softbody {

/// 0 to count - 1: the elements of a mesh as their own sources, as in SurfaceCut.
std::vector<int> ownSources(Eigen::Index count);

/// Binds the cut visual surface to the tets after an edit, without a jump: in the given state, earlier
/// vertices keep their positions, and new ones lie on the earlier surface. At rest all vertices are at their
/// rest positions.
/// @param now the surface before the edit; @param sources of its vertices in the mesh before the current
/// stroke;
/// @param cut of that mesh along the whole stroke; @param volume a state of the tets before the edit.
VisualSurface rebindSurface(const VisualSurface& now, const std::vector<int>& sources, SurfaceCut cut,
                            const TetEdit& edit, const MeshState& volume);

}  // namespace softbody
