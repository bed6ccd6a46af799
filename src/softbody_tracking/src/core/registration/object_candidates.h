#pragma once

#include <vector>

#include "prediction/color_model.h"
#include "softbody_tracking/rgbd_frame.h"

namespace softbody {

/// A connected piece of the depth image that may be the body.
struct ObjectCandidate {
  Eigen::Vector3d center;  ///< mean of its points, camera frame [m]
  int pixels = 0;
};

/// Pieces of about the body's size: connected in depth, of the body's colours where they are known, and not
/// on a plane that reaches far beyond the body (a table, a wall), be it behind what stands before it. Those
/// of a likely size and near the camera come first, and one of each thing before other parts of the same.
/// @param diameter_m of the body.
std::vector<ObjectCandidate> findObjectCandidates(const RgbdFrame& frame, const ColorModel& colors,
                                                  double diameter_m);

}  // namespace softbody
