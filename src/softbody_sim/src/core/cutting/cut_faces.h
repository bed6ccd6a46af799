#pragma once

#include <vector>

#include "core/cutting/crack_opening.h"
#include "core/cutting/patch_intersector.h"
#include "softbody_common/types.h"

namespace softbody {

/// Inner faces that follow the patch: their vertices are on the cut and the patch separates their two tets.
/// Ascending. @param on_cut per vertex.
std::vector<Face> facesAlong(const PatchIntersector& patch, const Points& vertices, const Tets& tets,
                             const std::vector<bool>& on_cut);

/// A crack opened as far as the surface stays a closed 2-manifold.
struct ManifoldCrack {
  OpenedTets opened;
  Triangles surface;               ///< of the opened tets
  std::vector<Face> closed_faces;  ///< still inside the body, by their vertices after opening; ascending
};

/// Opens a crack. Where a vertex on the cut would not be a manifold one, the faces at it stay closed.
/// @param cut_faces ascending; @param surface of the tets as they are.
ManifoldCrack openManifoldCrack(const Tets& tets, int vertex_count, const Triangles& surface,
                                std::vector<Face> cut_faces);

}  // namespace softbody
