#pragma once

namespace softbody::virtual_camera {

/// A cosine from 0 to 1 for x from 0 to 1; constant outside. The slope is continuous.
double smoothStep(double x);

/// 0 until `begin`, rises to 1 in `ramp`, stays 1 for `hold`, falls to 0 in `ramp` [s].
struct Plateau {
  double begin = 0.0, ramp = 1.0, hold = 0.0;
};
double plateau(double t, const Plateau& plateau);

/// A motion of 5 s that repeats: still for half a second, then one smooth swing to +1 and back, and one to -1
/// and back.
double swing(double t);

}  // namespace softbody::virtual_camera
