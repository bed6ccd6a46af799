#pragma once

#include <map>
#include <vector>

#include "softbody_common/types.h"

namespace softbody::evaluation {

/// Whether every edge is used once in each direction by triangles between distinct places (welded duplicates
/// count as one).
bool isClosed(const Points& vertices, const Triangles& triangles);

struct VolumeReport {
  bool closed = false;  ///< otherwise nothing below is known
  double rest_m3 = 0.0;
  double mean_change = 0.0;     ///< relative to the rest volume
  double largest_change = 0.0;  ///< the frame's with the largest magnitude, signed
  std::vector<double> changes;  ///< per frame
};

/// @param states of the topology's vertices, in time order.
VolumeReport volumeDrift(const MeshTopology& topology, const std::vector<const MeshState*>& states);

}  // namespace softbody::evaluation
