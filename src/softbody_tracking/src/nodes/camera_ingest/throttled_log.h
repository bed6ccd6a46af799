#pragma once

#include <ros/console.h>
#include <ros/time.h>

#include <map>
#include <string>

namespace softbody {

/// What is said again and again, each kind at its own pace. In wall time: ROS_WARN_THROTTLE counts ROS time,
/// which a bag that is held holds.
class WallThrottle {
 public:
  /// @param kind of the warning, whose words may change. @param period_s in which it is said once.
  void warn(const std::string& kind, const std::string& sentence, double period_s = 5.0) {
    if (isDue(kind, period_s)) ROS_WARN_STREAM(sentence);
  }
  void info(const std::string& kind, const std::string& sentence, double period_s = 5.0) {
    if (isDue(kind, period_s)) ROS_INFO_STREAM(sentence);
  }

 private:
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
