#pragma once

#include <vector>

#include "softbody_scanning/key_frames/key_frame.h"

namespace softbody::scanning {

/// Sharpness of an image: variance of its Laplacian (Pech-Pacheco et al. 2000).
double sharpnessOf(const cv::Mat3b& bgr);

/// Keeps the sharpest frame of each part of the camera's way.
class KeyFrameChoice {
 public:
  /// Looks at a frame. The images are kept, not copied.
  void add(KeyFrame frame);
  /// The frames that are chosen so far, in the order of time.
  const std::vector<KeyFrame>& chosen() const { return chosen_; }
  /// The same, given away.
  std::vector<KeyFrame> take();

 private:
  std::vector<KeyFrame> chosen_;                             // the last one is the best of the current part
  Eigen::Isometry3d start_ = Eigen::Isometry3d::Identity();  // T_camera_model at which the current part began
};

}  // namespace softbody::scanning
