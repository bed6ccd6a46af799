#pragma once

#include <vector>

#include "softbody_scanning/key_frames/key_frame.h"

namespace softbody::scanning {

/// The depth of a key frame, prepared for fusion.
struct DepthView {
  Pinhole camera;
  Eigen::Isometry3d T_camera_model = Eigen::Isometry3d::Identity();
  cv::Mat1f depth;    ///< z [m]; 0: no depth
  cv::Mat1f nearest;  ///< the nearest depth around each pixel [m]; 0: none
  /// Tangent plane of the surface at each pixel, camera frame: N . p = 1 for its points p [1/m]. Zero: none,
  /// as at an edge of depth.
  cv::Mat3f plane;
};

/// Standard deviation of inverse depth, the error of a stereo camera's disparity [1/m]: depth has sigma = it
/// times z^2. Measured as the scatter about local planes.
double measureInverseDepthNoise(const std::vector<KeyFrame>& frames);

/// Fits the tangent planes. Inverse depth of a plane is linear in the pixel; a window that is not, by more
/// than noise, shows an edge. @param inverse_depth_std see measureInverseDepthNoise().
DepthView makeDepthView(const KeyFrame& frame, double inverse_depth_std);

}  // namespace softbody::scanning
