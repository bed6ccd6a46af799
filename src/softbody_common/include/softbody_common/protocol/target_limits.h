#pragma once

namespace softbody {

/// The largest weight that the tracker gives to a target. The simulator must accept it.
constexpr double kLargestTargetWeight = 100.0;

/// Standard deviation of a target of weight 1 [m]. It weighs targets against pins.
constexpr double kTargetAccuracy_m = 0.001;

}  // namespace softbody
