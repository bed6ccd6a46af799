#pragma once

#include <vector>

#include "cutting/blade/tear_zone.h"

namespace softbody {

/// A tracked point of the body near a tear.
struct TearMark {
  Eigen::Vector3d rest, measured;  ///< [m]
  double deviation = 0.0;          ///< standard deviation in one direction [m]
  double side = 0.0;               ///< 1: on the side of the normal; -1: on the other side; 0: not known
};

/// The tracked points in the zone and in the tets around it. Two of them that are further apart than
/// material can be which is stretched by `limit`, by five standard deviations, have the tear between them. So
/// they say on which side of the tear they lie.
/// @param targets of the same revision. Depth is left out, for it does not hold a material point.
std::vector<TearMark> tearMarks(const TetTopology& volume, const Points& vertices,
                                const std::vector<Target>& targets, double limit, const TearZone& zone);

}  // namespace softbody
