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
  if (!verdict.accepted() && mayWarn())
    ROS_WARN_STREAM(fmt::format("{}: the message with the stamp {:.3f} s is not used: {}", topic_,
                                stamp.toSec(), whyRefused(verdict)));
  if (verdict.kind == StampVerdict::kJumpedBack)
    ROS_INFO_STREAM(
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
