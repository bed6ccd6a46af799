#pragma once

namespace softbody {

/// The tracker gives no target a greater weight, and a simulator has to be able to take it.
constexpr double kLargestTargetWeight = 100.0;

}  // namespace softbody
