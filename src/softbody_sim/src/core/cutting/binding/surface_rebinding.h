#pragma once

#include <vector>

#include "cutting/surface/surface_cut.h"
#include "cutting/volume/tet_edit.h"
#include "softbody_sim/interpolation/visual_surface.h"

namespace softbody {

/// The sources of a mesh's vertices and triangles in another mesh, as in SurfaceCut.
struct MeshSources {
  std::vector<int> vertices, triangles;
};

/// The identity: a mesh as its own source.
MeshSources ownSources(const MeshTopology& mesh);

/// Binds the cut visual surface to the tets after an edit, without a jump: in the given state, earlier
/// vertices keep their positions, and new ones lie on the earlier surface. At rest all vertices are at their
/// rest positions.
/// @param now the surface before the edit; @param sources of its mesh in the mesh before the current stroke;
/// @param cut of that mesh along the whole stroke; @param volume a state of the tets before the edit.
VisualSurface rebindSurface(const VisualSurface& now, const MeshSources& sources, SurfaceCut cut,
                            const TetEdit& edit, const MeshState& volume);

}  // namespace softbody
