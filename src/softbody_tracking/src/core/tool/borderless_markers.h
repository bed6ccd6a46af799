#pragma once

#include <vector>

#include "tool/aruco.h"

namespace softbody {

/// A marker recognized by its bits alone.
struct BorderlessMarker {
  int id;
  double side_px;  ///< of the whole marker, with its border
};

/// Finds markers whose black border cannot be told from what is around it, because there is no white margin.
/// Looks for groups of bright cells in dark surroundings, seen nearly from the front.
std::vector<BorderlessMarker> borderlessMarkers(const cv::Mat1b& gray, const aruco::Dictionary& dictionary);

}  // namespace softbody
