#pragma once

#include <Eigen/Geometry>
#include <opencv2/core.hpp>

#include "softbody_common/geometry/pinhole.h"
#include "softbody_common/geometry/types.h"

namespace softbody::scanning {

/// A frame of the recording that the model is made from, and where it was taken. The model's frame has its
/// origin on the table in the middle of the object, z up [m].
struct KeyFrame {
  Nanoseconds stamp = 0;
  Pinhole camera;
  cv::Mat3b color;  ///< BGR, rectified
  cv::Mat1f depth;  ///< z [m]; 0: no depth
  Eigen::Isometry3d T_camera_model = Eigen::Isometry3d::Identity();
  double sharpness = 0.0;  ///< see sharpnessOf()
};

}  // namespace softbody::scanning
