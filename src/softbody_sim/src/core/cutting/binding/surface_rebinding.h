#pragma once

#include <vector>

#include "cutting/surface/surface_cut.h"
#include "cutting/volume/tet_edit.h"
#include "softbody_sim/interpolation/visual_surface.h"

namespace softbody {

/// Where a mesh's vertices and triangles come from in another, as in SurfaceCut.
struct MeshSources {
  std::vector<int> vertices, triangles;
};

/// A mesh's own vertices and triangles.
MeshSources ownSources(const MeshTopology& mesh);

/// The visual surface over the tets after an edit, without a jump: in the given state, vertices that the
/// surface had before keep their positions, and new ones on it lie where it was. At rest all are at rest.
/// @param now the surface before the edit; @param sources its mesh's in the mesh before the current stroke;
/// @param cut that mesh along all of the stroke; @param volume a state of the tets before the edit.
VisualSurface rebindSurface(const VisualSurface& now, const MeshSources& sources, SurfaceCut cut,
                            const TetEdit& edit, const MeshState& volume);

}  // namespace softbody
