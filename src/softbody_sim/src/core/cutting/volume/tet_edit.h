#pragma once

#include <vector>

#include "cutting/volume/cut_faces.h"
#include "cutting/volume/cut_subdivision.h"
#include "softbody_common/geometry/types.h"

namespace softbody {

/// A topological edit of the tets, with the maps from the earlier topology.
struct TetEdit {
  TetTopology topology;   ///< after the edit; earlier vertices and tets keep their indices
  std::vector<bool> cut;  ///< per triangle of its surface: true if it was inside the uncut body
  std::vector<MaterialPoint> vertex_origins;  ///< per vertex: its place in the earlier topology
  std::vector<std::vector<int>> successors;   ///< per earlier tet: the tets that replace it

  /// A place of the earlier topology, in the successor that contains it or is nearest.
  MaterialPoint placeAfter(const MaterialPoint& place, const TetTopology& before) const;
};

/// Per vertex of a topology, its place: a corner of its lowest tet.
std::vector<MaterialPoint> placesOfVertices(const TetTopology& topology);

/// The edit that subdivided and opened the tets of a topology.
/// @param cut per triangle of the earlier surface: true if it was inside the uncut body.
TetEdit assembleEdit(const TetTopology& before, const std::vector<bool>& cut,
                     const CutSubdivision& subdivision, const ManifoldCrack& crack);

}  // namespace softbody
