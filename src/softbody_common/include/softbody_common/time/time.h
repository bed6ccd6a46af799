#pragma once

#include <cstdint>

#include "softbody_common/geometry/types.h"

namespace softbody {

/// The latest time that a message can hold, just below 2^32 s (4.3e18 ns). So the sum and the difference of
/// any two stamps are exact in nanoseconds, while ros::Time throws where its difference exceeds 2^31 s.
constexpr Nanoseconds kLatestTime = (std::int64_t{1} << 32) * 1'000'000'000 - 1;

inline double seconds(Nanoseconds duration) { return 1e-9 * static_cast<double>(duration); }

/// The nearest duration within +-kLatestTime; 0 for a value that is no number.
Nanoseconds nanoseconds(double seconds);

}  // namespace softbody
