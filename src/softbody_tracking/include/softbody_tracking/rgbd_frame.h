#pragma once

#include <Eigen/Geometry>
#include <opencv2/core.hpp>

#include "softbody_common/pinhole.h"
#include "softbody_common/types.h"

namespace softbody {

/// One rectified colour image with depth on the same grid.
struct RgbdFrame {
  Nanoseconds stamp = 0;
  Pinhole camera;
  cv::Mat3b color;  ///< BGR
  cv::Mat1f depth;  ///< z [m]; 0: none
  /// The camera in the frame that stands still, in which the body is simulated; identity: the camera's own.
  Eigen::Isometry3d T_fixed_camera = Eigen::Isometry3d::Identity();
  bool placed = true;      ///< false: where the camera is in that frame is not known
  cv::Mat1b covered = {};  ///< not 0: something known stands before the body; empty: nothing does
};

}  // namespace softbody
