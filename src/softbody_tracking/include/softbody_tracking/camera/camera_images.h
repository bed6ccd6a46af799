#pragma once

#include <Eigen/Geometry>
#include <opencv2/core.hpp>
#include <optional>
#include <vector>

#include "softbody_common/geometry/pinhole.h"
#include "softbody_common/geometry/types.h"

namespace softbody {

/// Distortion of a colour image, as in sensor_msgs/CameraInfo.
struct Distortion {
  cv::Matx33d K = cv::Matx33d::zeros();  ///< camera matrix of the raw image; zero: the image is rectified
  cv::Matx33d R = cv::Matx33d::eye();    ///< from the raw to the rectified camera frame
  std::vector<double> coefficients;      ///< plumb_bob or rational_polynomial; empty or all zero: none
  bool fisheye = false;                  ///< "equidistant"
};

/// Whether raw and rectified image are the same.
bool isAlreadyRectified(const Distortion& distortion, const Pinhole& rectified);

/// @throw std::invalid_argument unless images can be rectified with it.
void checkDistortion(const Distortion& distortion, const Pinhole& rectified);

/// A depth camera whose images are not registered to colour.
struct DepthCamera {
  Pinhole rectified;      ///< after rectification (P of its CameraInfo)
  Distortion distortion;  ///< of its raw images
  Eigen::Isometry3d T_color_depth = Eigen::Isometry3d::Identity();  ///< its pose in the raw colour camera
};

/// What a camera measured for one frame.
struct CameraImages {
  cv::Mat3b color;  ///< BGR
  cv::Mat depth;    ///< CV_16UC1 or CV_32FC1; NaN, infinity and 0: no depth at the pixel; empty: none at all
  Distortion distortion;  ///< of colour, and of depth that is registered to it
  Pinhole rectified;      ///< the colour camera after rectification (P of its CameraInfo)
  Nanoseconds stamp = 0;  ///< of colour
  std::optional<DepthCamera> depth_camera = {};  ///< nothing: depth is registered to colour and has its size
  double depth_unit_m = 0.0;                     ///< of depth [m]; 0: 1 mm of CV_16UC1, 1 m of CV_32FC1
  int pass = 0;                                  ///< see RgbdFrame
  bool registered_to_rectified = false;  ///< depth is registered to the colour image without distortion
};

/// The unit of depth [m].
inline double unitOf(const CameraImages& images) {
  if (images.depth_unit_m > 0.0) return images.depth_unit_m;
  return images.depth.type() == CV_16UC1 ? 0.001 : 1.0;
}

}  // namespace softbody
