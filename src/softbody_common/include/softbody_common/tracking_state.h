#pragma once

#include "softbody_common/types.h"

namespace softbody {

/// The state's name in messages to the user.
inline const char* nameOf(TrackingState state) {
  constexpr const char* kNames[] = {"initializing", "tracking", "degraded", "lost", "recovering"};
  return kNames[static_cast<int>(state)];
}

}  // namespace softbody
