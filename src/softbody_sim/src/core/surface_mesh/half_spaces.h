#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

namespace softbody {

/// normal . x >= offset.
struct HalfSpace {
  Eigen::Vector3d normal;  ///< unit
  double offset;
};

/// The point nearest to a given one that lies in all half-spaces, or nothing if there is none.
/// @param tolerance by which a half-space may be missed [m].
std::optional<Eigen::Vector3d> nearestPointIn(const std::vector<HalfSpace>& half_spaces,
                                              const Eigen::Vector3d& point, double tolerance);

}  // namespace softbody
