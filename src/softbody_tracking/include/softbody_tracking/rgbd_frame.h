#pragma once

#include <opencv2/core.hpp>

#include "softbody_common/pinhole.h"
#include "softbody_common/types.h"

namespace softbody {

/// One rectified colour image with depth on the same grid.
struct RgbdFrame {
  Nanoseconds stamp = 0;
  Pinhole camera;
  cv::Mat3b color;  ///< BGR
  cv::Mat1f depth;  ///< z [m]; 0: none
};

}  // namespace softbody
