#pragma once

#include <opencv2/core.hpp>

#include "softbody_tracking/camera/camera_ingest.h"

namespace softbody {

/// Resamples images of one camera onto its rectified pinhole; the maps are made once for a camera.
class Rectifier {
 public:
  /// @throw std::invalid_argument if the distortion makes no sense.
  void setCamera(const Distortion& distortion, const Pinhole& rectified);

  bool isIdentity() const { return identity_; }
  /// Bilinear; black outside. The same image where there is nothing to rectify.
  cv::Mat3b color(const cv::Mat3b& raw) const;
  /// Nearest, as depths of two surfaces must not be mixed; 0 outside. z is turned into the rectified frame
  /// (R).
  cv::Mat1f depth(const cv::Mat1f& raw) const;

 private:
  void makeMaps();

  Distortion distortion_;
  Pinhole rectified_;
  bool identity_ = true;
  cv::Mat bilinear_, bilinear_fraction_, nearest_;
  cv::Mat1f depth_scale_;  ///< rectified z per raw z; empty where R is the identity
};

}  // namespace softbody
