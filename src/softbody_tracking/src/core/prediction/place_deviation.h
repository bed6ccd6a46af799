#pragma once

#include <vector>

#include "softbody_common/geometry/types.h"

namespace softbody {

/// Standard deviation of a place [m], interpolated from the corners of its tet; 0 if none is estimated.
/// @param deviations of the volume's vertices [m]; empty: not estimated.
inline double deviationAt(const MaterialPoint& place, const TetTopology& volume,
                          const std::vector<float>& deviations) {
  if (deviations.size() != static_cast<std::size_t>(volume.rest_vertices.rows()) || place.tet < 0) return 0.0;
  double deviation = 0.0;
  for (int k = 0; k < 4; ++k)
    deviation += place.barycentric[k] * deviations[static_cast<std::size_t>(volume.tets(place.tet, k))];
  return deviation;
}

}  // namespace softbody
