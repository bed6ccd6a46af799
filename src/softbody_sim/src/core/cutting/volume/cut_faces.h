#pragma once

#include <vector>

#include "cutting/patch/patch_intersector.h"
#include "cutting/volume/crack_opening.h"
#include "softbody_common/geometry/types.h"

namespace softbody {

/// Inner faces along the patch: their vertices are on the cut and the patch separates their two tets.
/// Ascending. @param on_cut per vertex.
std::vector<Face> facesAlong(const PatchIntersector& patch, const Points& vertices, const Tets& tets,
                             const std::vector<bool>& on_cut);

/// A crack, opened only where the surface stays a closed 2-manifold.
struct ManifoldCrack {
  OpenedTets opened;
  Triangles surface;               ///< of the opened tets
  std::vector<Face> closed_faces;  ///< not opened, by their vertices after opening; ascending
  std::vector<int> pinches;        ///< vertices with closed faces, where the surface would touch itself
};

/// Opens a crack. The faces at a vertex stay closed if the surface would touch itself there.
/// @param cut_faces ascending; @param known vertices at which the uncut surface is non-manifold; ascending.
ManifoldCrack openManifoldCrack(const Tets& tets, int vertex_count, std::vector<Face> cut_faces,
                                const std::vector<int>& known);

}  // namespace softbody
