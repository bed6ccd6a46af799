#pragma once

#include <vector>

#include "softbody_common/types.h"

namespace softbody {

/// An edge of a tet mesh and the vertex that splits it.
struct EdgeSplit {
  int a = -1;
  int b = -1;  ///< a < b
  int vertex = -1;
};

/// Tets after bisection, and the tet that each is a part of.
struct BisectedTets {
  Tets tets;                 ///< the first part of tet t is tet t; further parts follow all
  std::vector<int> parents;  ///< #tets
};

/// Bisects all tets round every split edge, edges in the given order. A face's parts depend on that order
/// alone, not on the tet that asks: the mesh stays conforming. Every part has a positive share of its tet.
BisectedTets bisectEdges(const Tets& tets, const std::vector<EdgeSplit>& splits);

}  // namespace softbody
