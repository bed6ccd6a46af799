#include "solid/key_states.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace softbody::virtual_camera {

KeyStates::KeyStates(double first, double last, std::vector<Points> states)
    : first_(first), last_(last), states_(std::move(states)) {
  const std::size_t end = states_.size() - 1;
  const Points before = 2.0 * states_[0] - states_[1], after = 2.0 * states_[end] - states_[end - 1];
  states_.insert(states_.begin(), before);
  states_.push_back(after);
}

Points KeyStates::at(double parameter) const {
  const auto intervals = static_cast<double>(states_.size() - 3);
  const double steps = std::clamp((parameter - first_) / (last_ - first_), 0.0, 1.0) * intervals;
  const double whole = std::min(std::floor(steps), intervals - 1.0), s = steps - whole;
  const Points* around = &states_[static_cast<std::size_t>(whole)];
  return (0.5 * s * (-1.0 + s * (2.0 - s))) * around[0] + (1.0 + 0.5 * s * s * (-5.0 + 3.0 * s)) * around[1] +
         (0.5 * s * (1.0 + s * (4.0 - 3.0 * s))) * around[2] + (0.5 * s * s * (-1.0 + s)) * around[3];
}

}  // namespace softbody::virtual_camera
