#pragma once

#include <opencv2/core.hpp>
#include <string>

#include "softbody_common/geometry/pinhole.h"
#include "softbody_common/geometry/types.h"

namespace softbody::evaluation {

/// A colour image of a recording and its depth, both without lens distortion.
struct RecordedFrame {
  Nanoseconds stamp = 0;  ///< of the colour image
  std::string frame_id;
  Pinhole camera;
  cv::Mat3b color;  ///< b, g, r
  cv::Mat1f depth;  ///< registered to colour [m]; 0: not measured. Empty if the frame has no depth image
};

}  // namespace softbody::evaluation
