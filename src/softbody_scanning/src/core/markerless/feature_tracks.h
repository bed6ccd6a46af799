#pragma once

#include <Eigen/Geometry>
#include <opencv2/core.hpp>
#include <vector>

#include "markerless/tracked_frame.h"

namespace softbody::scanning {

inline cv::Size trackingWindow() { return {17, 17}; }
constexpr int kTrackingLevels = 3;  // finds what is up to 60 px off

/// An anchor of one frame, seen in another.
struct Sighting {
  int anchor = 0;        ///< index in the first frame
  Eigen::Vector2d from;  ///< its pixel
  double from_inverse_depth = 0.0;
  Eigen::Vector2d to;             ///< its pixel in the second frame
  double to_inverse_depth = 0.0;  ///< measured there [1/m]; 0: none
};

/// Finds the anchors of a frame in another one by their grey levels (pyramidal Lucas-Kanade, Bouguet 2000),
/// forward and back. @param T_to_from expected pose.
std::vector<Sighting> trackAnchors(const TrackedFrame& from, const TrackedFrame& to,
                                   const Eigen::Isometry3d& T_to_from);

}  // namespace softbody::scanning
