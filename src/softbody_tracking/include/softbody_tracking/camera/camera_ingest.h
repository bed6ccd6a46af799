#pragma once

#include <memory>
#include <vector>

#include "softbody_common/parameters.h"
#include "softbody_tracking/rgbd_frame.h"

namespace softbody {

struct CameraIngestConfig {
  /// Two neighbouring pixels belong to one surface if their depths differ by less than this fraction of z.
  /// Surfaces are kept up to a slant of about atan(ratio * focal length in px): 80 degrees at 275 px, 85 at
  /// 600.
  double edge_jump_ratio = 0.02;
  double min_depth_m = 0.1, max_depth_m = 5.0;  ///< depth outside of this range is removed
};

/// @throw std::invalid_argument as Parameters does.
CameraIngestConfig readCameraIngestConfig(Parameters& parameters);

/// Distortion of a colour image, as in sensor_msgs/CameraInfo.
struct Distortion {
  cv::Matx33d K = cv::Matx33d::zeros();  ///< camera matrix of the raw image; zero: the image is rectified
  cv::Matx33d R = cv::Matx33d::eye();    ///< from the raw to the rectified camera frame
  std::vector<double> coefficients;      ///< plumb_bob or rational_polynomial; empty or all zero: none
  bool fisheye = false;                  ///< "equidistant"
};

/// A depth camera whose images are not registered to colour.
struct DepthCamera {
  Pinhole rectified;      ///< after rectification (P of its CameraInfo)
  Distortion distortion;  ///< of its raw images
  Eigen::Isometry3d T_color_depth = Eigen::Isometry3d::Identity();  ///< its pose in the raw colour camera
};

/// Makes a rectified RgbdFrame without flying pixels from raw colour and registered depth.
class CameraIngest {
 public:
  explicit CameraIngest(const CameraIngestConfig& config);
  ~CameraIngest();

  /// @param color BGR; the frame shares its memory if it is already rectified.
  /// @param depth CV_16UC1 [mm] or CV_32FC1 [m]; NaN, infinity and 0: no depth at the pixel; an empty image:
  /// no depth at all.
  /// @param rectified the camera after rectification (P of CameraInfo).
  /// @param depth_camera null: depth is registered to colour and has its size; otherwise it is registered
  /// here.
  /// @throw std::invalid_argument if the sizes, the types or the distortion are wrong.
  RgbdFrame process(const cv::Mat3b& color, const cv::Mat& depth, const Distortion& distortion,
                    const Pinhole& rectified, Nanoseconds stamp, const DepthCamera* depth_camera = nullptr);

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace softbody
