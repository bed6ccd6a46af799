#pragma once

#include <vector>

#include "softbody_common/types.h"

namespace softbody::virtual_camera {

/// Diffuse light at the corners of triangles. Corners at one vertex share a normal unless their triangles
/// meet in a crease.
class CornerShading {
 public:
  /// Appends a mesh whose triangles come next in the list of all. @param crease_angle_rad edges that are
  /// sharper than this at rest stay edges.
  void add(const TriangleMesh& rest, double crease_angle_rad);

  /// @param triangles of all meshes. @param to_light unit.
  void light(const Points& vertices, const Triangles& triangles, const Eigen::Vector3d& to_light);

  /// Brightness at a corner 0..2 of a triangle, 0..1, of the last light.
  float at(int triangle, int corner) const {
    return brightness_[static_cast<std::size_t>(
        normal_[3 * static_cast<std::size_t>(triangle) + static_cast<std::size_t>(corner)])];
  }

 private:
  std::vector<int> normal_;            ///< per corner (3 f + k): which of the shared normals is its own
  std::vector<std::size_t> first_{0};  ///< per shared normal and the end: its first one of the next list
  std::vector<int> triangles_;         ///< that a shared normal is the mean of
  std::vector<float> brightness_;      ///< per shared normal
};

}  // namespace softbody::virtual_camera
