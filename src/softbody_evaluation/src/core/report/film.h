#pragma once

#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "softbody_common/geometry/types.h"

namespace softbody::evaluation {

/// One frame of a recording with the result drawn on it.
struct FilmFrame {
  Nanoseconds stamp = 0;
  std::string caption;
  cv::Mat3b overlay;  ///< camera image with the mesh's outline and lines that are fixed to the body
  cv::Mat3b sides;    ///< the mesh from four sides, painted with its error
};

/// Frames at equal intervals.
using Film = std::vector<FilmFrame>;

}  // namespace softbody::evaluation
