#pragma once

#include <Eigen/Core>

namespace softbody {

/// A camera without distortion. Pixel centres are at integer coordinates, as in sensor_msgs/CameraInfo.
/// Camera frame: x right, y down, z forward (REP-103 optical frame) [m].
struct Pinhole {
  int width = 0, height = 0;                      ///< [px]
  double fx = 0.0, fy = 0.0, cx = 0.0, cy = 0.0;  ///< [px]

  /// Pixel (u, v) of a point with z > 0.
  Eigen::Vector2d project(const Eigen::Vector3d& p) const {
    return {fx * p.x() / p.z() + cx, fy * p.y() / p.z() + cy};
  }
  /// The point at depth z [m] behind pixel (u, v).
  Eigen::Vector3d unproject(double u, double v, double z) const {
    return {(u - cx) / fx * z, (v - cy) / fy * z, z};
  }
  bool contains(double u, double v) const {
    return u >= 0.0 && v >= 0.0 && u <= width - 1.0 && v <= height - 1.0;
  }
};

inline bool operator==(const Pinhole& a, const Pinhole& b) {
  return a.width == b.width && a.height == b.height && a.fx == b.fx && a.fy == b.fy && a.cx == b.cx &&
         a.cy == b.cy;
}

}  // namespace softbody
