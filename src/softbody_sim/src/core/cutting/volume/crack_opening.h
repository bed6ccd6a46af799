#pragma once

#include <array>
#include <vector>

#include "softbody_common/geometry/types.h"

namespace softbody {

/// The vertices of a face in ascending order.
using Face = std::array<int, 3>;

/// The face opposite to a corner of a tet.
Face faceOf(const Tets& tets, int tet, int corner);

/// A tet mesh after vertices along a crack have been duplicated.
struct OpenedTets {
  Tets tets;
  std::vector<int> copied_from;  ///< per new vertex, the one that it copies
};

/// Opens a crack by duplicating vertices. The tets around a vertex form groups that are connected through
/// uncut faces. The group with the lowest tet keeps the vertex, every other group gets a copy. At the front
/// of the crack the tets are one group, so it stays closed.
/// @param cut_faces ascending.
OpenedTets openCrack(const Tets& tets, int vertex_count, const std::vector<Face>& cut_faces);

}  // namespace softbody
