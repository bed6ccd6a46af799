#pragma once

#include <Eigen/Core>
#include <opencv2/features2d.hpp>
#include <vector>

#include "softbody_tracking/rgbd_frame.h"
#include "softbody_tracking/tracker/tracking_result.h"

namespace softbody::evaluation {

/// Features of the first frame, followed from frame to frame by ORB alone, as Kang et al. 2022 do. A feature
/// carries the descriptor of the frame in which it was last found, so errors add up.
class FrameFeatures {
 public:
  /// @param most features. @param body depth of the body in each pixel of the first frame [m]; 0: not the
  /// body.
  FrameFeatures(int most, const RgbdFrame& first, const cv::Mat1f& body);

  /// The features that a frame shows. Descriptors of all corners of the image are compared by brute force; a
  /// pair is taken if each is the other's nearest. A feature whose motion differs from that of its neighbours
  /// is an outlier, and not found.
  std::vector<TrackedFeature> follow(const RgbdFrame& frame);

  /// Where each feature was last found.
  const std::vector<TrackedFeature>& all() const { return features_; }

 private:
  cv::Ptr<cv::ORB> orb_;
  std::vector<TrackedFeature> features_;
  cv::Mat1b descriptors_;  ///< one row for each feature
};

}  // namespace softbody::evaluation
