#include "nodes/surface/targets_input.h"

#include <stdexcept>

#include "softbody_common/protocol/topics.h"
#include "softbody_common/ros/conversions.h"

namespace softbody {
namespace {

constexpr std::size_t kKept = 10;  // a slow simulator answers some frames later

}  // namespace

TargetsInput::TargetsInput(ros::NodeHandle node)
    : subscriber_(node.subscribe(topics::kTargets, kKept, &TargetsInput::onTargets, this,
                                 ros::TransportHints().tcpNoDelay())) {}

void TargetsInput::onTargets(const softbody_msgs::TargetsConstPtr& message) {
  last_.push_back(message);
  if (last_.size() > kKept) last_.pop_front();
}

/// The simulator refuses the same targets, and says so.
TargetSet TargetsInput::of(const std_msgs::Header& header) const {
  for (auto message = last_.rbegin(); message != last_.rend(); ++message) {
    if ((*message)->header.stamp != header.stamp || (*message)->header.frame_id != header.frame_id) continue;
    try {
      return fromMessage(**message);
    } catch (const std::invalid_argument&) {
      return {};
    }
  }
  return {};
}

}  // namespace softbody
