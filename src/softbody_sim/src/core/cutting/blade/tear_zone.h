#pragma once

#include <vector>

#include "cutting/blade/tet_stretch.h"

namespace softbody {

/// A plane in the rest body.
struct RestPlane {
  Eigen::Vector3d point = Eigen::Vector3d::Zero();    ///< [m]
  Eigen::Vector3d normal = Eigen::Vector3d::UnitX();  ///< unit
};

/// Where a body tears, as far as its tets tell.
struct TearZone {
  RestPlane plane;         ///< through the middle of the stretch, across its mean direction
  double place_m = 0.0;    ///< standard deviation of the plane along its normal [m]
  double tilt_rad = 0.0;   ///< standard deviation of its normal in one direction
  std::vector<bool> tets;  ///< per tet: part of the zone
};

/// The zone around an overstretched tet: the tets that are connected with it by vertices and are surely
/// stretched by more than `strain`.
TearZone tearZone(const TetTopology& volume, const std::vector<TetStretch>& stretches, int first,
                  double strain);

/// Tets that share a vertex with one of these tets. @param tets #T
std::vector<bool> tetsAround(const TetTopology& volume, const std::vector<bool>& tets);

}  // namespace softbody
