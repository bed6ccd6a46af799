#include "tool/corner_noise.h"

#include <algorithm>
#include <cmath>

namespace softbody {
namespace {

constexpr double kMemory = 30.0;  // frames: the light and the distance change within a second
/// What the configured value counts: as much as one marker alone, which has 8 coordinates for 6 parameters.
constexpr double kPriorFreedom = 2.0;

}  // namespace

double CornerNoise::std_px() const {
  const double factor = (kPriorFreedom + sum_) / freedom();
  return configured_px_ * std::sqrt(std::max(1.0, factor));
}

double CornerNoise::freedom() const { return kPriorFreedom + freedom_; }

void CornerNoise::add(double cost, double freedom) {
  const double scale = std_px() / configured_px_, kept = 1.0 - 1.0 / kMemory;
  sum_ = kept * sum_ + scale * scale * cost;
  freedom_ = kept * freedom_ + freedom;
}

}  // namespace softbody
