#include "prediction/tracking_signal.h"

#include <algorithm>

#include "prediction/memory.h"

namespace softbody {
namespace {

// Square of white noise, as a share of the square of its second difference: 1 / (1 + 4 + 1).
constexpr double kNoiseShare = 1.0 / 6.0;
// Smallest share of a measurement that is followed, so that no error lasts.
constexpr double kSmallestGain = 0.02;

}  // namespace

void TrackingSignal::observe(const Points& corrections, double elapsed_s) {
  const Eigen::Index count = corrections.rows();
  if (gains_.empty()) {
    last_ = before_ = corrections;
    square_ = corrections.rowwise().squaredNorm();
    noise_.setZero(count);
  } else {
    const double share = newestShare(elapsed_s, kMemory_s);
    const Points rough = corrections - 2.0 * last_ + before_;
    noise_ += share * (kNoiseShare * rough.rowwise().squaredNorm() - noise_);
    square_ += share * (corrections.rowwise().squaredNorm() - square_);
    before_ = last_;
    last_ = corrections;
  }
  gains_.resize(static_cast<std::size_t>(count));
  for (Eigen::Index v = 0; v < count; ++v) {
    const double noise = square_[v] > 0.0 ? noise_[v] / square_[v] : 0.0;
    gains_[static_cast<std::size_t>(v)] = std::clamp(1.0 - noise, kSmallestGain, 1.0);
  }
}

}  // namespace softbody
