#pragma once

#include <vector>

#include "cutting/volume/edge_bisection.h"
#include "cutting/volume/edge_crossings.h"

namespace softbody {

/// The least height of a tet over its longest edge (a regular tet: 0.82): what is below is a sliver.
double tetQuality(const Points& vertices, const Eigen::RowVector4i& tet);

/// Limits within which the tets follow the patch.
struct SubdivisionSettings {
  double snap_fraction = 0.02;   ///< a crossing that is closer to an edge's end, in edge lengths, moves there
  double least_quality = 0.02;   ///< so does one that would make a worse tet (tetQuality)
  double worst_quality = 0.001;  ///< the same at vertices that must not be taken if it can be helped
};

/// A tet mesh subdivided so that no edge crosses the patch between two vertices off the cut.
struct CutSubdivision {
  Points vertices;  ///< new ones after the old, in coordinates that single precision holds
  BisectedTets parts;
  std::vector<EdgeCrossing> splits;  ///< per new vertex, the split edge
  std::vector<bool> on_cut;          ///< per vertex: lies on the cut
};

/// Splits crossed edges at the crossing, or takes an end for a vertex of the cut.
/// @param on_cut, spared per vertex: lies on the cut already; is to be taken only for the worst slivers.
CutSubdivision subdivide(const Points& vertices, const Tets& tets, const std::vector<EdgeCrossing>& crossings,
                         const SubdivisionSettings& settings, std::vector<bool> on_cut,
                         const std::vector<bool>& spared);

}  // namespace softbody
