#pragma once

#include <opencv2/core.hpp>

#include "softbody_tracking/camera/camera_images.h"

namespace softbody {

/// Resamples images onto the rectified pinhole camera. The maps are computed only when the camera changes.
class Rectifier {
 public:
  /// @throw std::invalid_argument if the distortion is invalid.
  void setCamera(const Distortion& distortion, const Pinhole& rectified);

  bool isIdentity() const { return identity_; }
  /// Bilinear interpolation; black outside of the raw image. Returns raw itself if it is already rectified.
  cv::Mat3b color(const cv::Mat3b& raw) const;
  /// Nearest neighbour, because depths of two surfaces must not be mixed; NaN outside of the raw image. z
  /// is given in the rectified camera frame (R). @param raw not the result's memory.
  /// Only if not isIdentity().
  void depth(const cv::Mat1f& raw, cv::Mat1f* result) const;

 private:
  void makeMaps();

  Distortion distortion_;
  Pinhole rectified_;
  bool identity_ = true;
  cv::Mat bilinear_, bilinear_fraction_, nearest_;
  cv::Mat1f depth_scale_;  ///< rectified z divided by raw z; empty if R is the identity
};

}  // namespace softbody
