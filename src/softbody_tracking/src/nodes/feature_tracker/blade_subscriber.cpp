#include "nodes/feature_tracker/blade_subscriber.h"

#include <fmt/format.h>
#include <tf2/exceptions.h>

#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

#include "softbody_common/protocol/topics.h"
#include "softbody_common/ros/conversions.h"

namespace softbody {
namespace {

constexpr int kBladeQueue = 100;  // blades that may arrive while one frame is tracked

}  // namespace

BladeSubscriber::BladeSubscriber(ros::NodeHandle handle, PoseLookup look_up)
    : look_up_(std::move(look_up)),
      stamps_(handle.resolveName(topics::kToolBlade), StampGate::Repeats::kAccepted) {
  subscriber_ = handle.subscribe(topics::kToolBlade, kBladeQueue, &BladeSubscriber::onBlade, this,
                                 ros::TransportHints().tcpNoDelay());
}

void BladeSubscriber::onBlade(const geometry_msgs::PolygonStamped::ConstPtr& message) try {
  Points corners = fromMessage(message->polygon);
  if (!stamps_.admits(message->header.stamp)) return;
  blades_.add({toNanoseconds(message->header.stamp), message->header.frame_id, std::move(corners)});
} catch (const std::invalid_argument& error) {
  ROS_WARN_STREAM_THROTTLE(5.0, subscriber_.getTopic()
                                    << " is not used: " << error.what() << "; rostopic info "
                                    << subscriber_.getTopic() << " names the sender");
}

RgbdFrame BladeSubscriber::withoutBlade(const RgbdFrame& frame) {
  std::string reason;  // of the oldest blade without a pose
  const auto look_up = [&](const ReportedBlade& blade) -> std::optional<Eigen::Isometry3d> {
    std_msgs::Header header;
    header.stamp = toTime(blade.stamp);
    header.frame_id = blade.frame_id;
    try {
      return look_up_(header);
    } catch (const tf2::TransformException& error) {
      if (reason.empty()) reason = error.what();
      return std::nullopt;
    }
  };
  const BladeBuffer::Rejected rejected = blades_.updateMask(frame.stamp, look_up, &mask_);
  if (rejected.expired > 0) ROS_WARN_STREAM_THROTTLE(5.0, "the blade's pose is unknown: " << reason);
  if (rejected.lead > 0)
    ROS_WARN_STREAM_THROTTLE(
        5.0, fmt::format("the blade does not cover the body: its stamp is {:.1f} s ahead of the frame's. "
                         "Both must come from one clock",
                         seconds(rejected.lead)));
  return mask_.withoutBlade(frame);
}

}  // namespace softbody
