#pragma once

#include <Eigen/Geometry>

namespace softbody {

/// A rigid shape that the body cannot enter: a half-space, or a box grown by a radius. A box of size 0 gives
/// a sphere, a box that is a line gives a capsule.
struct Obstacle {
  bool half_space = false;                                 ///< everything below the xy plane of its frame
  Eigen::Vector3d half_extents = Eigen::Vector3d::Zero();  ///< of the box, along its frame's axes [m]
  double radius = 0.0;                                     ///< [m]
  double friction = 0.0;                                   ///< coefficient of Coulomb friction
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();  ///< its frame in the targets' frame

  static Obstacle plane();
  static Obstacle sphere(double radius_m);
  /// The axis is z. @param length_m distance between the centres of the caps.
  static Obstacle capsule(double radius_m, double length_m);
  /// @param sizes_m full edge lengths, rounding included.
  /// @throw std::invalid_argument if the rounding exceeds half the smallest size.
  static Obstacle box(const Eigen::Vector3d& sizes_m, double rounding_m);
};

/// A signed distance and its gradient, the outward normal of the nearest surface point.
struct SurfaceDistance {
  double distance = 0.0;  ///< [m], negative inside
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();
};

/// @param point in the obstacle's frame [m].
SurfaceDistance distanceTo(const Obstacle& obstacle, const Eigen::Vector3d& point);

}  // namespace softbody
