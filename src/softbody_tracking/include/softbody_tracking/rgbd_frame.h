#pragma once

#include <Eigen/Geometry>
#include <opencv2/core.hpp>

#include "softbody_common/geometry/pinhole.h"
#include "softbody_common/geometry/types.h"

namespace softbody {

/// One rectified colour image with depth on the same grid.
struct RgbdFrame {
  Nanoseconds stamp = 0;
  Pinhole camera;
  cv::Mat3b color;  ///< BGR
  cv::Mat1f depth;  ///< z [m]; NaN or 0: no depth, so that only z > 0 says that there is one
  /// The camera's pose in the fixed frame, in which the body is simulated. The identity if the fixed frame is
  /// the camera's frame.
  Eigen::Isometry3d T_fixed_camera = Eigen::Isometry3d::Identity();
  bool placed = true;  ///< false: T_fixed_camera is unknown
  cv::Mat1b covered =
      {};  ///< not 0: a known object, such as the blade, occludes the body; empty: no such object
  /// Depth of the known surface that a pixel shows [m]; 0: none, empty: no known surface is in view.
  cv::Mat1f known = {};
  int pass = 0;  ///< of the recording: with another one time has jumped back, and tracking starts again
};

}  // namespace softbody
