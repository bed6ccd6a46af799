#pragma once

#include <vector>

#include "softbody_common/geometry/types.h"

namespace softbody {

/// An edge of a tet mesh and the vertex that splits it.
struct EdgeSplit {
  int a = -1;
  int b = -1;  ///< a < b
  int vertex = -1;
};

/// Tets after bisection, and their parents.
struct BisectedTets {
  Tets tets;                 ///< the first part of tet t is tet t; further parts come after all first parts
  std::vector<int> parents;  ///< #tets
};

/// Bisects all tets around every split edge, in the given order of edges. The parts of a face depend on that
/// order only, the same for both of its tets: the mesh stays conforming. Every part has positive volume.
BisectedTets bisectEdges(const Tets& tets, const std::vector<EdgeSplit>& splits);

}  // namespace softbody
