#pragma once

#include <string>
#include <vector>

#include "cutting/patch/cut_patch.h"
#include "surface_mesh/manifold_mesh.h"

namespace softbody {

enum class CutOutcome {
  kCut,      ///< the mesh is cut
  kMissed,   ///< the patch only grazes the surface, or does not meet it
  kRefused,  ///< the cut cannot be made
};

/// A visual mesh after a cut. Without a cut, revision and rest shape are unchanged.
struct SurfaceCut {
  CutOutcome outcome = CutOutcome::kMissed;
  std::string reason;  ///< why the mesh was not cut
  MeshTopology mesh;
  std::vector<int> vertex_sources;  ///< per vertex, its earlier vertex or the original of the copy; -1: new
  std::vector<bool> on_new_wall;    ///< per triangle: this cut made it
  ManifoldMesh manifold;            ///< form of the mesh, if it is cut
};

/// Cuts a closed triangle mesh along a patch. Triangles are divided along the curve of intersection. The mesh
/// is opened there and closed by two copies of the inner part of the patch, the walls. Where the patch ends
/// inside the body, the two walls meet. Where the patch is nearer to a vertex or an edge than 1/20,000 of the
/// body's diagonal, it is moved there. Triangles at the cut are remeshed, within 1/2000 of the diagonal. New
/// coordinates are rounded to single precision, as they are published. Rounded new triangles are at least
/// 1/400,000 of the diagonal high.
/// @param mesh may be non-manifold in edges and vertices: splitNonManifold separates its sheets first.
/// @throw std::invalid_argument if the mesh is not closed or the patch is not an oriented surface.
SurfaceCut cutSurface(const MeshTopology& mesh, const CutPatch& patch);

/// The same for a mesh whose manifold form is known, which saves time.
SurfaceCut cutSurface(const MeshTopology& mesh, const ManifoldMesh& manifold, const CutPatch& patch);

}  // namespace softbody
