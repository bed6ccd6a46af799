#pragma once

#include <vector>

#include "softbody_scanning/key_frames/key_frame.h"

namespace softbody::scanning {

/// Measured depth over the depth of the table z = 0 where a region of it is seen: 1 if the unit of depth and
/// the size of the printed sheet are right. Median over all frames; 0 if the table is not measured.
double depthScale(const std::vector<KeyFrame>& frames, const Eigen::AlignedBox3d& region);

}  // namespace softbody::scanning
