#pragma once

namespace softbody::virtual_camera {

/// From 0 to 1 along a cosine while x goes from 0 to 1; constant outside, with a continuous slope.
double smoothStep(double x);

/// 0 until `begin`, up to 1 within `ramp`, 1 for `hold`, down to 0 within `ramp` again [s].
struct Plateau {
  double begin = 0.0, ramp = 1.0, hold = 0.0;
};
double plateau(double t, const Plateau& plateau);

/// Still for half a second, then one smooth swing to +1 and back and one to -1 and back, 5 s in all, over and
/// over.
double swing(double t);

}  // namespace softbody::virtual_camera
