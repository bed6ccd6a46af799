#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "softbody_common/types.h"

namespace softbody {

/// A vertex held at a place, in the frame of the targets.
struct Pin {
  int vertex = -1;
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< [m]
};

/// A rigid shape that the body cannot enter: a half-space, or a box grown by a radius, which is a sphere
/// where the box is a point and a capsule where it is a line.
struct Obstacle {
  bool half_space = false;                                 ///< all below the xy plane of its frame
  Eigen::Vector3d half_extents = Eigen::Vector3d::Zero();  ///< of the box, along its frame's axes [m]
  double radius = 0.0;                                     ///< [m]
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();  ///< its frame in the targets' frame

  static Obstacle plane();
  static Obstacle sphere(double radius_m);
  /// Along z; the length is that of the axis, between the centres of the caps.
  static Obstacle capsule(double radius_m, double length_m);
  /// Full sizes, edges included. @throw std::invalid_argument if the rounding exceeds half the smallest size.
  static Obstacle box(const Eigen::Vector3d& sizes_m, double rounding_m);
};

/// A signed distance, and its gradient: the outward normal of the nearest surface point.
struct SurfaceDistance {
  double distance = 0.0;  ///< [m], below 0 inside
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();
};

/// Of a point in the obstacle's frame.
SurfaceDistance distanceTo(const Obstacle& obstacle, const Eigen::Vector3d& point);

/// What acts on the body beside targets and gravity.
struct Surroundings {
  std::vector<Pin> pins;
  std::vector<Obstacle> obstacles;  ///< the k-th is the one that was k-th in the step before
  Points loads;                     ///< #V by 3 forces [N], or empty
};

/// What a body does to a pin or an obstacle, in the targets' frame.
struct Wrench {
  Eigen::Vector3d force = Eigen::Vector3d::Zero();  ///< [N]
  Eigen::Vector3d torque =
      Eigen::Vector3d::Zero();  ///< about the pin, or the origin of the obstacle's frame [N m]
};

/// The body's forces on its surroundings at the end of a step.
struct Reactions {
  std::vector<Wrench> pins;
  std::vector<Wrench> obstacles;
};

}  // namespace softbody
