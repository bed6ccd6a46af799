#include "softbody_virtual_camera/rendering/exposure.h"

#include <algorithm>
#include <cmath>

#include "softbody_common/statistics/random.h"

namespace softbody::virtual_camera {
namespace {

constexpr double kTwoPi = 6.28318530717958647692;

/// The sum of two waves without a common period, in -1..1.
double wander(double t, double period_s, std::uint64_t seed) {
  const double slow = std::sin(kTwoPi * (t / period_s + unit(hash(seed, 1))));
  const double fast = std::sin(kTwoPi * (2.6180339887 * t / period_s + unit(hash(seed, 2))));
  return 0.7 * slow + 0.3 * fast;
}

}  // namespace

void ExposureDrift::apply(double t, cv::Mat3b* color) const {
  if (!options_.enabled) return;
  const auto gain = [&](double largest, std::uint64_t number) {
    return 1.0 + largest * wander(t, options_.period_s, hash(seed_, number));
  };
  const double exposure = gain(options_.exposure, 1);
  const double gains[3] = {exposure * gain(options_.white_balance, 2), exposure,
                           exposure * gain(options_.white_balance, 3)};
  cv::Mat3b table(1, 256);
  for (int level = 0; level < 256; ++level) {
    for (int k = 0; k < 3; ++k) table(0, level)[k] = cv::saturate_cast<uchar>(gains[k] * level);
  }
  cv::LUT(*color, table, *color);
}

int blurImages(const MotionBlurOptions& options, double motion_px) {
  if (!options.enabled) return 1;
  return static_cast<int>(std::clamp(std::ceil(motion_px / options.step_px), 1.0, 1.0 * options.max_images));
}

}  // namespace softbody::virtual_camera
