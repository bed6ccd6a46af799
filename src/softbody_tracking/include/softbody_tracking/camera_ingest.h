#pragma once

#include <memory>

#include "softbody_common/parameters.h"
#include "softbody_tracking/rgbd_frame.h"

namespace softbody {

struct CameraIngestConfig {
  double edge_jump_ratio = 0.02;    ///< a depth further than this fraction of z from most of its neighbours is flying
  double min_depth_m = 0.1, max_depth_m = 5.0;
};

/// @throw std::invalid_argument as Parameters does.
CameraIngestConfig readCameraIngestConfig(Parameters& parameters);

/// Distortion of a colour image as in sensor_msgs/CameraInfo.
struct Distortion {
  cv::Matx33d K = cv::Matx33d::zeros();
  cv::Matx33d R = cv::Matx33d::eye();
  std::vector<double> coefficients;   ///< plumb_bob or rational_polynomial; empty or all zero: none
  bool fisheye = false;               ///< "equidistant"
};

/// From raw colour and registered depth to a rectified RgbdFrame without flying pixels.
class CameraIngest {
 public:
  explicit CameraIngest(const CameraIngestConfig& config) : config_(config) {}

  /// @param color BGR; @param depth CV_16UC1 [mm] or CV_32FC1 [m], NaN, infinity and 0 mean none, same size as color.
  /// @param rectified the camera after rectification (P of CameraInfo).
  /// @throw std::invalid_argument if sizes or types do not fit.
  RgbdFrame process(const cv::Mat3b& color, const cv::Mat& depth, const Distortion& distortion,
                    const Pinhole& rectified, Nanoseconds stamp);

 private:
  CameraIngestConfig config_;
};

}  // namespace softbody
