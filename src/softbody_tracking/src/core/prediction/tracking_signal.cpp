#include "prediction/tracking_signal.h"

#include <algorithm>
#include <cmath>

namespace softbody {
namespace {

// Time over which corrections are averaged [s]: some frames tell noise from motion.
constexpr double kMemory = 0.15;
// Smallest share of a measurement that is followed, so that no error lasts.
constexpr double kSmallestGain = 0.02;

}  // namespace

void TrackingSignal::observe(const Points& corrections, double elapsed_s) {
  const bool first = gains_.empty();
  if (first) {
    product_.setZero(corrections.rows());
    square_ = corrections.rowwise().squaredNorm();
  } else {
    const double share = 1.0 - std::exp(-elapsed_s / kMemory);
    product_ += share * (corrections.cwiseProduct(last_).rowwise().sum() - product_);
    square_ +=
        share * (0.5 * (corrections.rowwise().squaredNorm() + last_.rowwise().squaredNorm()) - square_);
  }
  last_ = corrections;
  gains_.resize(static_cast<std::size_t>(corrections.rows()));
  for (Eigen::Index v = 0; v < corrections.rows(); ++v) {
    const double correlation = square_[v] > 0.0 ? product_[v] / square_[v] : 0.0;
    gains_[static_cast<std::size_t>(v)] = first ? 1.0 : std::clamp(correlation, kSmallestGain, 1.0);
  }
}

}  // namespace softbody
