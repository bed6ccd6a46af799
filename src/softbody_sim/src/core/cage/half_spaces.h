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

/// The point in all half-spaces that is nearest to a given one; nothing if the half-spaces have no common
/// point.
/// @param tolerance how far the result may lie outside of a half-space [m].
std::optional<Eigen::Vector3d> nearestPointIn(const std::vector<HalfSpace>& half_spaces,
                                              const Eigen::Vector3d& point, double tolerance);

}  // namespace softbody
