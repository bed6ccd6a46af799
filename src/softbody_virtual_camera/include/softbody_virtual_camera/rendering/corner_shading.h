#pragma once

#include <vector>

#include "softbody_common/geometry/types.h"
#include "softbody_virtual_camera/scenes/scene.h"

namespace softbody::virtual_camera {

/// Diffuse light at the corners of triangles. Corners at one vertex share a normal, except across a crease.
class CornerShading {
 public:
  /// Appends a mesh to the list of triangles. @param crease_angle_rad edges with a larger angle at rest are
  /// creases.
  void add(const TriangleMesh& rest, double crease_angle_rad);

  /// Computes the brightness from the normals of these vertices (Lambert). @param triangles of all meshes.
  void light(const Points& vertices, const Triangles& triangles, const Lights& lights);

  /// Brightness (0..1) at a corner (0..2) of a triangle, from the last call of light().
  float at(int triangle, int corner) const {
    return brightness_[static_cast<std::size_t>(
        normal_[3 * static_cast<std::size_t>(triangle) + static_cast<std::size_t>(corner)])];
  }

 private:
  std::vector<int> normal_;            ///< per corner (3 f + k): index of its shared normal
  std::vector<std::size_t> first_{0};  ///< per shared normal, and the end: its first index in triangles_
  std::vector<int> triangles_;         ///< the triangles of each shared normal
  std::vector<float> brightness_;      ///< per shared normal
};

}  // namespace softbody::virtual_camera
