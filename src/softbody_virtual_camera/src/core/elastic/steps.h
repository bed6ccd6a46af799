#pragma once

#include "motion/motion_profiles.h"

namespace softbody::virtual_camera {

constexpr double kStepsDuration_s = 5.5;

/// From 0 to 0.6, later to 1: the second step is new in the last fifth of the scene, for predictions.
inline double inTwoSteps(double t) {
  return 0.6 * smoothStep((t - 0.8) / 1.5) + 0.4 * smoothStep((t - 4.2) / 1.1);
}

}  // namespace softbody::virtual_camera
