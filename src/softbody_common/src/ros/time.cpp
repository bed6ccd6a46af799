#include "softbody_common/ros/time.h"

#include <algorithm>

namespace softbody {

Nanoseconds toNanoseconds(const ros::Time& time) {
  // On the wire nsec may exceed a second, also in the last one.
  return std::min(static_cast<Nanoseconds>(time.toNSec()), kLatestTime);
}

ros::Time toTime(Nanoseconds time) {
  return ros::Time().fromNSec(static_cast<std::uint64_t>(std::clamp<Nanoseconds>(time, 0, kLatestTime)));
}

ros::Duration toDuration(Nanoseconds duration) {
  constexpr Nanoseconds kLongest = kLatestTime / 2;
  return ros::Duration().fromNSec(std::clamp(duration, -kLongest, kLongest));
}

double secondsBetween(const ros::Time& from, const ros::Time& to) {
  return seconds(toNanoseconds(to) - toNanoseconds(from));
}

}  // namespace softbody
