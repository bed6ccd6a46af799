#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <vector>

#include "softbody_common/geometry/types.h"

namespace softbody {

/// A feature of the body, found in one frame.
struct TrackedFeature {
  int id = 0;
  Eigen::Vector2d pixel;      ///< (u, v) [px]
  Eigen::Vector3d position;   ///< measured, camera frame [m]
  Eigen::Vector3d reference;  ///< position when first seen, in the camera frame of this frame [m]
  double confidence = 0.0;    ///< share of the frames in which it was found, 0..1
};

/// The result of one frame.
struct TrackingResult {
  bool has_targets = false;  ///< false: nothing to simulate (waiting, or not found)
  TargetSet targets;         ///< fixed frame
  std::vector<TrackedFeature> features;
  TrackingStatus status;
  cv::Rect labelled;  ///< the part of the image that is labelled, around the body; may be empty [px]
  cv::Mat1b labels;   ///< what each of its pixels shows, see softbody_common/images/pixel_labels.h
};

}  // namespace softbody
