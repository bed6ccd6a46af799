#pragma once

#include <string>
#include <vector>

#include "cutting/patch/cut_patch.h"
#include "cutting/split/manifold_mesh.h"

namespace softbody {

enum class CutOutcome {
  kCut,      ///< the mesh is cut
  kMissed,   ///< the patch only grazes the surface, or does not meet it
  kRefused,  ///< the cut cannot be made
};

/// A visual mesh after a cut. Revision and rest shape are the mesh's before, unless it is cut.
struct SurfaceCut {
  CutOutcome outcome = CutOutcome::kMissed;
  std::string reason;  ///< of what was not cut
  MeshTopology mesh;
  std::vector<int> vertex_sources;    ///< per vertex the one before that it is or was copied from; -1: new
  std::vector<int> triangle_sources;  ///< per triangle the one before that it is a part of; -1: of a new wall
  ManifoldMesh manifold;              ///< of the mesh, if it is cut
};

/// Cuts a closed triangle mesh along a patch: triangles are divided along the curve of intersection, the mesh
/// is opened there and closed by the part of the patch inside of it, once for each side. Where the patch ends
/// inside, the two walls meet. A patch that passes a vertex or an edge within a 20,000th of the body's
/// diagonal passes through it. New coordinates are rounded to single precision, as they are published; no
/// triangle that the cut makes is then lower than a 400,000th of the diagonal.
/// @param mesh its sheets may touch in edges and vertices: these are parted first.
/// @throw std::invalid_argument if the mesh is not closed, or the patch is no oriented surface.
SurfaceCut cutSurface(const MeshTopology& mesh, const CutPatch& patch);

/// The same for a mesh whose sheets are known, which spares looking at all of it again.
SurfaceCut cutSurface(const MeshTopology& mesh, const ManifoldMesh& manifold, const CutPatch& patch);

}  // namespace softbody
