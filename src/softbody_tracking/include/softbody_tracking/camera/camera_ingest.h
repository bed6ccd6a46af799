#pragma once

#include <memory>
#include <vector>

#include "softbody_common/parameters.h"
#include "softbody_tracking/rgbd_frame.h"

namespace softbody {

struct CameraIngestConfig {
  /// A neighbour within this fraction of z belongs to the same surface. Surfaces stay up to a slant of about
  /// atan(ratio * focal length in px): 80 degrees at 275 px, 85 at 600.
  double edge_jump_ratio = 0.02;
  double min_depth_m = 0.1, max_depth_m = 5.0;
};

/// @throw std::invalid_argument as Parameters does.
CameraIngestConfig readCameraIngestConfig(Parameters& parameters);

/// Distortion of a colour image as in sensor_msgs/CameraInfo.
struct Distortion {
  cv::Matx33d K = cv::Matx33d::zeros();
  cv::Matx33d R = cv::Matx33d::eye();
  std::vector<double> coefficients;  ///< plumb_bob or rational_polynomial; empty or all zero: none
  bool fisheye = false;              ///< "equidistant"
};

/// From raw colour and registered depth to a rectified RgbdFrame without flying pixels.
class CameraIngest {
 public:
  explicit CameraIngest(const CameraIngestConfig& config);
  ~CameraIngest();

  /// @param color BGR; shared with the frame where nothing has to be rectified.
  /// @param depth CV_16UC1 [mm] or CV_32FC1 [m], same size as color; NaN, infinity and 0 mean none; empty: no
  /// depth.
  /// @param rectified the camera after rectification (P of CameraInfo).
  /// @throw std::invalid_argument if sizes, types or the distortion do not fit.
  RgbdFrame process(const cv::Mat3b& color, const cv::Mat& depth, const Distortion& distortion,
                    const Pinhole& rectified, Nanoseconds stamp);

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace softbody
