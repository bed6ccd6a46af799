#include "softbody_bringup/virtual_camera/bend.h"

#include <cmath>

namespace softbody::virtual_camera {
namespace {

constexpr double kPi = 3.14159265358979323846;

double sinc(double x) { return std::abs(x) < 1e-6 ? 1.0 : std::sin(x) / x; }

}  // namespace

Eigen::Vector3d bend(const Eigen::Vector3d& rest, double curvature) {
  const double angle = curvature * rest.x();
  const double along = rest.x() * sinc(angle);
  const double half = sinc(0.5 * angle);
  const double sag = 0.5 * rest.x() * angle * half * half;
  return {along - rest.z() * std::sin(angle), rest.y(), sag + rest.z() * std::cos(angle)};
}

double bendCurvature(double t) {
  constexpr double kPeriod = 5.0, kStill = 0.5, kLargest = 7.0;  // [s], [s], [1/m]
  const double phase = (std::fmod(t, kPeriod) - kStill) / (kPeriod - kStill);
  if (phase <= 0.0) return 0.0;
  const double pulse = 0.5 * (1.0 - std::cos(4.0 * kPi * phase));
  return (phase < 0.5 ? kLargest : -kLargest) * pulse;
}

}  // namespace softbody::virtual_camera
