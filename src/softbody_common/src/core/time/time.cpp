#include "softbody_common/time/time.h"

#include <algorithm>
#include <cmath>

namespace softbody {

Nanoseconds nanoseconds(double seconds) {
  if (std::isnan(seconds)) return 0;
  constexpr double kLatest_s = 4294967295.0;
  return std::llround(1e9 * std::clamp(seconds, -kLatest_s, kLatest_s));
}

}  // namespace softbody
