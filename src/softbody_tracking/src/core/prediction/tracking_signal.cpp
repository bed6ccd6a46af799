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
    mean_ = corrections;
    mean_length_ = corrections.rowwise().norm();
  } else {
    const double share = 1.0 - std::exp(-elapsed_s / kMemory);
    mean_ += share * (corrections - mean_);
    mean_length_ += share * (corrections.rowwise().norm() - mean_length_);
  }
  gains_.resize(static_cast<std::size_t>(corrections.rows()));
  for (Eigen::Index v = 0; v < corrections.rows(); ++v) {
    const double signal = mean_length_[v] > 0.0 ? mean_.row(v).norm() / mean_length_[v] : 0.0;
    gains_[static_cast<std::size_t>(v)] = first ? 1.0 : std::clamp(signal * signal, kSmallestGain, 1.0);
  }
}

}  // namespace softbody
