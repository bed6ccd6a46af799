#pragma once

#include <vector>

#include "cutting/volume/edge_bisection.h"
#include "cutting/volume/edge_crossings.h"

namespace softbody {

/// The smallest height of a tet over its longest edge (a regular tet: 0.82). Small values are slivers.
double tetQuality(const Points& vertices, const Eigen::RowVector4i& tet);

/// Limits for moving a crossing to the end of its edge.
struct SubdivisionSettings {
  double snap_fraction =
      0.02;  ///< a crossing closer to an edge's end than this, in edge lengths, moves there
  double least_quality = 0.02;   ///< it also moves there if a tet of lower quality would result (tetQuality)
  double worst_quality = 0.001;  ///< the same limit at spared vertices
};

/// A tet mesh subdivided so that no edge crosses the patch between two vertices off the cut.
struct CutSubdivision {
  Points vertices;  ///< old ones, then new ones; representable in single precision
  BisectedTets parts;
  std::vector<EdgeCrossing> splits;  ///< per new vertex, the split edge
  std::vector<bool> on_cut;          ///< per vertex: lies on the cut
};

/// Splits crossed edges at the crossing, or puts an end of the edge on the cut. @param on_cut per vertex:
/// already lies on the cut. @param spared per vertex: put on the cut only to avoid the worst slivers.
CutSubdivision subdivide(const Points& vertices, const Tets& tets, const std::vector<EdgeCrossing>& crossings,
                         const SubdivisionSettings& settings, std::vector<bool> on_cut,
                         const std::vector<bool>& spared);

}  // namespace softbody
