#pragma once

#include <string>

#include "softbody_common/geometry/types.h"

namespace softbody::evaluation {

/// What the tracker said of one frame.
struct StatusRecord {
  Nanoseconds stamp = 0;
  TrackingState state = TrackingState::kInitializing;
  int alike = 1;  ///< poses that look alike, one of which the tracker took
};

}  // namespace softbody::evaluation
