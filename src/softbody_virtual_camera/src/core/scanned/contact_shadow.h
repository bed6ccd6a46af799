#pragma once

#include <opencv2/core.hpp>

#include "softbody_common/geometry/types.h"
#include "softbody_virtual_camera/textures/texture.h"

namespace softbody::virtual_camera {

/// The light that a plane z = 0 gets below and beside a body: the less, the nearer the body is above it.
class ContactShadow {
 public:
  /// @param body where it lies, in the frame of the plane.
  explicit ContactShadow(const TriangleMesh& body);

  /// 1: nothing is near. @param place on the plane [m].
  float lightAt(const Eigen::Vector3d& place) const;
  /// A texture of the plane, in this light.
  Texture on(const Texture& texture) const;

 private:
  Eigen::Vector2d corner_;  ///< middle of the first cell [m]
  double cell_m_ = 0.0;
  cv::Mat1f light_;  ///< x along the columns, y along the rows
};

}  // namespace softbody::virtual_camera
