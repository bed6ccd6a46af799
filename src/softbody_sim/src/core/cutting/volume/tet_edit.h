#pragma once

#include <vector>

#include "cutting/volume/cut_faces.h"
#include "cutting/volume/cut_subdivision.h"
#include "softbody_common/types.h"

namespace softbody {

/// A topological edit of the tets and what whoever holds something of the topology before needs.
struct TetEdit {
  TetTopology topology;                       ///< after: vertices and tets of before keep their numbers
  std::vector<bool> cut;                      ///< per triangle of its surface: was inside the uncut body
  std::vector<MaterialPoint> vertex_origins;  ///< per vertex: its place in the topology before
  std::vector<std::vector<int>> successors;   ///< per tet before: the tets that took its room

  /// A place of the topology before, in the successor that contains it or is nearest.
  MaterialPoint placeAfter(const MaterialPoint& place, const TetTopology& before) const;
};

/// Per vertex of a topology its place at a corner of its lowest tet.
std::vector<MaterialPoint> placesOfVertices(const TetTopology& topology);

/// The edit that subdivided and opened the tets of a topology.
/// @param cut per triangle of its surface: was inside the uncut body.
TetEdit assembleEdit(const TetTopology& before, const std::vector<bool>& cut,
                     const CutSubdivision& subdivision, const ManifoldCrack& crack);

}  // namespace softbody
