#pragma once

#include <vector>

#include "cutting/patch/patch_intersector.h"
#include "softbody_common/geometry/types.h"

namespace softbody {

/// A crossing of a patch and an edge of a tet mesh.
struct EdgeCrossing {
  int a = -1;
  int b = -1;      ///< a < b
  int tet = -1;    ///< one of the tets at the edge
  double t = 0.0;  ///< fraction of the way from a to b
  int nearEnd() const { return t < 0.5 ? a : b; }
  double fraction() const { return t < 0.5 ? t : 1.0 - t; }  ///< from the nearer end
};

/// The edges whose ends the patch separates, the longest first, each once. Edges with an end in `on_cut` are
/// skipped. @param on_cut per vertex.
std::vector<EdgeCrossing> edgeCrossings(const Points& vertices, const Tets& tets,
                                        const std::vector<bool>& on_cut, const PatchIntersector& patch);

}  // namespace softbody
