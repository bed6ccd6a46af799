#pragma once

#include <ros/time.h>

#include <string>
#include <utility>

#include "softbody_common/time/timeline.h"

namespace softbody {

/// Judges the stamps of a topic by the ROS clock, and logs what it refuses.
class StampGate {
 public:
  /// Whether several messages of the topic may belong to one stamp.
  enum class Repeats { kRefused, kAccepted };

  /// @param topic name for the log.
  explicit StampGate(std::string topic, Repeats repeats = Repeats::kRefused)
      : topic_(std::move(topic)), repeats_(repeats) {}

  /// Call it with messages whose content is valid: a message that is refused must not move time.
  StampVerdict judge(const ros::Time& stamp);
  /// Whether a message is used.
  bool admits(const StampVerdict& verdict) const {
    return repeats_ == Repeats::kAccepted ? verdict.acceptedOrSame() : verdict.accepted();
  }
  bool admits(const ros::Time& stamp) { return admits(judge(stamp)); }

  int pass() const { return timeline_.pass(); }

 private:
  bool mayWarn();

  std::string topic_;
  Repeats repeats_;
  Timeline timeline_;
  RefusedStamps refused_;
  ros::SteadyTime last_warning_;
};

}  // namespace softbody
