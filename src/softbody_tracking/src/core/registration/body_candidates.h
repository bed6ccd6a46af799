#pragma once

#include <vector>

#include "prediction/color_model.h"
#include "softbody_tracking/rgbd_frame.h"

namespace softbody {

/// A connected part of the depth image that may be the body.
struct BodyCandidate {
  Eigen::Vector3d center;  ///< mean of its points, camera frame [m]
  int pixels = 0;
};

/// Parts of the depth image that may be the body, the likeliest first. A candidate has about the body's size
/// and is connected in depth. If the body's colours are known, it has these colours. It does not lie on a
/// plane much larger than the body (a table, a wall), even if objects before this plane divide it. One
/// candidate of each object comes before other parts of the same object.
/// @param diameter_m of the body.
std::vector<BodyCandidate> findBodyCandidates(const RgbdFrame& frame, const ColorModel& colors,
                                              double diameter_m);

}  // namespace softbody
