#pragma once

#include <array>
#include <vector>

#include "softbody_common/types.h"

namespace softbody {

/// A face's vertices in ascending order.
using Face = std::array<int, 3>;

/// The face opposite to a corner of a tet.
Face faceOf(const Tets& tets, int tet, int corner);

/// A tet mesh whose vertices were copied along a crack.
struct OpenedTets {
  Tets tets;
  std::vector<int> copied_from;  ///< per further vertex, the one that it copies
};

/// Opens a crack: the tets around a vertex fall into groups that are connected through faces not cut; the
/// group of the lowest tet keeps the vertex, every other gets a copy. The crack's front, where the tets still
/// hang together, stays closed by itself.
/// @param cut_faces ascending.
OpenedTets openCrack(const Tets& tets, int vertex_count, const std::vector<Face>& cut_faces);

}  // namespace softbody
