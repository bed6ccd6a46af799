#pragma once

#include <cmath>

namespace softbody::evaluation {

constexpr double kDegrees = 180.0 / M_PI;  ///< of one radian
constexpr double mm(double metres) { return 1e3 * metres; }

}  // namespace softbody::evaluation
