#pragma once

#include <Eigen/Geometry>
#include <opencv2/core.hpp>
#include <vector>

#include "softbody_common/geometry/pinhole.h"

namespace softbody::scanning {

/// A place in an image whose surface is smooth, to be found again in other images.
struct Anchor {
  cv::Point2f pixel;
  double inverse_depth = 0.0;  ///< of the plane fitted around it [1/m]
};

/// A frame, prepared to be matched with others.
struct TrackedFrame {
  Pinhole camera;
  std::vector<cv::Mat> pyramid;  ///< grey levels without exposure and shading
  cv::Mat1f depth;               ///< z [m]; 0: none
  cv::Mat3f plane;               ///< N with N . p = 1, camera frame [1/m]; zero: none. Empty: not prepared
  std::vector<Anchor> anchors;
};

/// Only what following needs: the pyramid.
TrackedFrame followedFrame(const Pinhole& camera, const cv::Mat3b& color, const cv::Mat1f& depth);

/// Adds planes and anchors. @param inverse_depth_std see measureInverseDepthNoise().
void addAnchors(double inverse_depth_std, TrackedFrame* frame);

}  // namespace softbody::scanning
