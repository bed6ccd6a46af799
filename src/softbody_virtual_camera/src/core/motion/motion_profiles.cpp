#include "motion/motion_profiles.h"

#include <algorithm>
#include <cmath>

namespace softbody::virtual_camera {

double smoothStep(double x) { return 0.5 * (1.0 - std::cos(M_PI * std::clamp(x, 0.0, 1.0))); }

double plateau(double t, const Plateau& plateau) {
  const double fall = plateau.begin + plateau.ramp + plateau.hold;
  return smoothStep((t - plateau.begin) / plateau.ramp) - smoothStep((t - fall) / plateau.ramp);
}

double swing(double t) {
  constexpr double kPeriod = 5.0, kStill = 0.5;  // [s]
  const double phase = (std::fmod(t, kPeriod) - kStill) / (kPeriod - kStill);
  if (phase <= 0.0) return 0.0;
  const double pulse = 0.5 * (1.0 - std::cos(4.0 * M_PI * phase));
  return (phase < 0.5 ? 1.0 : -1.0) * pulse;
}

}  // namespace softbody::virtual_camera
