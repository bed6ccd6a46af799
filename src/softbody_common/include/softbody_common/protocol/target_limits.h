#pragma once

namespace softbody {

/// The largest weight that the tracker gives to a target. The simulator must accept it.
constexpr double kLargestTargetWeight = 100.0;

}  // namespace softbody
