#pragma once

#include <utility>
#include <vector>

#include "softbody_common/time/time.h"
#include "softbody_sim/constraints/surroundings.h"

namespace softbody {

/// When external forces are estimated: at most five times a second, because an estimate takes as long as
/// several steps.
class ForceSchedule {
 public:
  /// Whether the last estimate is too old, or of other pins. Then a new one must follow.
  bool isDue(const std::vector<Pin>& pins, Nanoseconds stamp) {
    constexpr double kPeriod_s = 0.2;
    std::vector<int> held;
    for (const Pin& pin : pins) held.push_back(pin.vertex);
    const double since_s = seconds(stamp - stamp_);
    if (since_s >= 0.0 && since_s < kPeriod_s && held == held_) return false;
    stamp_ = stamp;
    held_ = std::move(held);
    return true;
  }

 private:
  Nanoseconds stamp_ = 0;
  std::vector<int> held_;  ///< vertices
};

}  // namespace softbody
