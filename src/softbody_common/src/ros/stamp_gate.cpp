#include "softbody_common/ros/stamp_gate.h"

#include <fmt/format.h>
#include <ros/console.h>

#include "softbody_common/ros/time.h"

namespace softbody {
namespace {

constexpr double kWarningPeriod_s = 5.0;

}  // namespace

StampVerdict StampGate::judge(const ros::Time& stamp) {
  const StampVerdict verdict = timeline_.judge(toNanoseconds(stamp), toNanoseconds(ros::Time::now()));
  const std::optional<RefusedStamp> refused = refused_.note(toNanoseconds(stamp), verdict);
  if (refused && !admits(refused->verdict) && mayWarn())
    ROS_WARN_STREAM(fmt::format("{}: the message with the stamp {:.3f} s is not used: {}", topic_,
                                seconds(refused->stamp), whyRefused(refused->verdict)));
  // Only camera_ingest tells the user that a recording starts again.
  if (verdict.kind == StampVerdict::kJumpedBack)
    ROS_DEBUG_STREAM(
        fmt::format("{}: time jumped back by {:.3f} s: a new pass starts", topic_, -seconds(verdict.gap)));
  return verdict;
}

/// Each topic has its own period; ROS_WARN_THROTTLE has one for each line of code.
bool StampGate::mayWarn() {
  const ros::SteadyTime now = ros::SteadyTime::now();
  if (!last_warning_.isZero() && (now - last_warning_).toSec() < kWarningPeriod_s) return false;
  last_warning_ = now;
  return true;
}

}  // namespace softbody
