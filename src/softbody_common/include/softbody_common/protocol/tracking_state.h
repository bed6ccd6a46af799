#pragma once

#include <cstdio>
#include <string>

#include "softbody_common/geometry/types.h"

namespace softbody {

/// The state's name in messages to the user.
inline const char* nameOf(TrackingState state) {
  constexpr const char* kNames[] = {"initializing", "tracking", "degraded", "lost", "recovering"};
  return kNames[static_cast<int>(state)];
}

/// The reason of a status while the body is tracked in one of several poses that look alike.
inline std::string alikeReason(int poses) {
  std::string reason = "tracked in one of " + std::to_string(poses) + " poses that look alike";
  return reason;
}

/// The number of poses that look alike, from the reason of a status; 1 if it does not say so.
inline int posesAlike(const std::string& reason) {
  const std::size_t begin = reason.find("tracked in one of ");
  int poses = 0, end = 0;
  if (begin == std::string::npos) return 1;
  std::sscanf(reason.c_str() + begin, "tracked in one of %d poses that look alike%n", &poses, &end);
  return end > 0 && poses > 1 ? poses : 1;
}

}  // namespace softbody
