#pragma once

#include <string>

#include "softbody_common/geometry/types.h"

namespace softbody {

/// The tracker's state in a short sentence. Its reason is told separately.
std::string sentenceOf(TrackingState state);

/// Features, inliers and residual of a status in one line.
std::string numbersOf(const TrackingStatus& status);

}  // namespace softbody
