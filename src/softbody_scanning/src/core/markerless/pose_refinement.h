#pragma once

#include <vector>

#include "softbody_scanning/key_frames/key_frame.h"

namespace softbody::scanning {

/// How well the key frames' poses agree.
struct RefinementReport {
  int pairs = 0;               ///< of frames that see the same
  int loops = 0;               ///< of these, pairs that are far apart in time
  double loop_before_m = 0.0;  ///< rms disagreement of the loops before, at the object
  double loop_after_m = 0.0;   ///< and after
  double pixel_std = 0.0;      ///< of the tracked places, measured [px]
  double position_std_m =
      0.0;  ///< of the frames at the object, relative to the first: root of the mean variance
};

/// Makes the poses agree. Pairs of frames that see the same place are aligned by texture and depth, also if
/// they are far apart in time. Then all poses are adjusted together. The first frame stays. @param frames in
/// the order of time, with poses that are about right. @throw std::invalid_argument if no frame has depth.
RefinementReport refinePoses(std::vector<KeyFrame>* frames);

}  // namespace softbody::scanning
