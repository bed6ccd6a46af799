#include "ros/replay/recorded_surroundings.h"

#include <fmt/format.h>
#include <rosbag/view.h>
#include <std_msgs/Bool.h>
#include <tf2/exceptions.h>

#include <iterator>

#include "softbody_common/ros/time.h"
#include "softbody_recordings/ros/input_bag.h"
#include "softbody_recordings/ros/typed_message.h"

namespace softbody {

RecordedSurroundings::RecordedSurroundings(const rosbag::Bag& bag, const SurroundingsConfig& config,
                                           const Warn& warn) try
    : transforms_({bag.getFileName()}) {
  for (const std::string& warning : transforms_.warnings()) warn(warning);
  if (!config.gripper) return;
  rosbag::View view(bag, rosbag::TopicQuery(config.gripper_closed));
  for (const rosbag::MessageInstance& message : view)
    closed_[message.getTime()] = instantiate<std_msgs::Bool>(message, bag)->data != 0;
  if (closed_.empty())
    warn(
        fmt::format("the gripper never closes: {} has no message on {}; record it, or name its topic in "
                    "the gripper's YAML",
                    bag.getFileName(), config.gripper_closed));
} catch (const rosbag::BagException& error) {
  throw damagedBag(bag.getFileName(), error);
}

SurroundingsInput RecordedSurroundings::at(const std::string& fixed_frame, const ros::Time& stamp) const {
  SurroundingsInput input;
  input.lookup = [this, fixed_frame](const std::string& frame,
                                     Nanoseconds time) -> std::optional<StampedPose> {
    try {
      return StampedPose{transforms_.at(fixed_frame, frame, toTime(time)), time};
    } catch (const tf2::TransformException&) {
      return std::nullopt;
    }
  };
  const auto after = closed_.upper_bound(stamp);
  if (after != closed_.begin()) input.gripper_closed = std::prev(after)->second;
  return input;
}

}  // namespace softbody
