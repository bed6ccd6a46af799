#pragma once

#include <ros/console.h>
#include <ros/time.h>

#include <map>
#include <string>

namespace softbody {

/// Logs each kind of message at most once per period of wall time. ROS_WARN_THROTTLE uses ROS time, which
/// does not advance while a bag is paused, and one period for each line of code.
class ThrottledLog {
 public:
  /// @param kind identifies the message, whose text may change.
  void warn(const std::string& kind, const std::string& message, double period_s = 5.0) {
    if (isDue(kind, period_s)) ROS_WARN_STREAM(message);
  }
  void info(const std::string& kind, const std::string& message, double period_s = 5.0) {
    if (isDue(kind, period_s)) ROS_INFO_STREAM(message);
  }

 private:
  /// Whether the message may be logged now; if so, its period starts.
  bool isDue(const std::string& kind, double period_s) {
    const ros::WallTime now = ros::WallTime::now();
    const auto [last, first] = last_.try_emplace(kind, now);
    if (!first && (now - last->second).toSec() < period_s) return false;
    last->second = now;
    return true;
  }

  std::map<std::string, ros::WallTime> last_;
};

}  // namespace softbody
