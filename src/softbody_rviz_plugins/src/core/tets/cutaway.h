#pragma once

#include <vector>

#include "softbody_common/geometry/types.h"

namespace softbody {

/// A plane across the body's axes at rest: tets on its far side are not drawn.
struct CutawayPlane {
  int axis = 0;           ///< 0 x, 1 y, 2 z of the rest frame
  double position = 1.0;  ///< 0: the body's lowest coordinate; 1: its highest
  bool flip = false;      ///< the tets below the plane are hidden, not those above
};

/// The outer faces of the tets that stay.
struct CutawayFaces {
  Triangles triangles;    ///< outward
  std::vector<int> tets;  ///< per triangle: the tet that it belongs to
};

/// The tets whose centres at rest are on the near side, and their faces that no other of them shares.
CutawayFaces cutawayFaces(const TetTopology& topology, const CutawayPlane& plane);

}  // namespace softbody
