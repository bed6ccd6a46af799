#pragma once

#include "softbody_common/types.h"

namespace softbody {

/// As users read it.
inline const char* nameOf(TrackingState state) {
  constexpr const char* kNames[] = {"initializing", "tracking", "degraded", "lost", "recovering"};
  return kNames[static_cast<int>(state)];
}

}  // namespace softbody
