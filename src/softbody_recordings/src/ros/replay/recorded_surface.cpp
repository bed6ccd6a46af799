#include "ros/replay/recorded_surface.h"

#include <fmt/format.h>
#include <softbody_msgs/MeshState.h>
#include <softbody_msgs/MeshTopology.h>
#include <tf2/exceptions.h>

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "softbody_common/ros/conversions.h"
#include "softbody_common/ros/frame_name.h"
#include "softbody_recordings/ros/typed_message.h"

namespace softbody {
namespace {

/// Calls `use` with each message of a view. One that cannot be used is left out; the first is named.
template <typename Message>
void forEachUsable(rosbag::View& view, const rosbag::Bag& bag, const RecordedSurface::Warn& warn,
                   const std::function<void(const Message&, const rosbag::MessageInstance&)>& use) {
  bool warned = false;
  for (const rosbag::MessageInstance& instance : view) {
    try {
      use(*instantiate<Message>(instance, bag), instance);
    } catch (const std::exception& error) {
      if (!std::exchange(warned, true))
        warn(fmt::format("a message on {} is not used: {}", instance.getTopic(), error.what()));
    }
  }
}

}  // namespace

RecordedSurface::RecordedSurface(const rosbag::Bag& bag, std::string name, const Warn& warn)
    : name_(std::move(name)),
      topology_view_(std::make_unique<rosbag::View>(bag, rosbag::TopicQuery(name_ + "/topology"))),
      state_view_(std::make_unique<rosbag::View>(bag, rosbag::TopicQuery(name_ + "/state"))),
      surface_(name_) {
  forEachUsable<softbody_msgs::MeshTopology>(
      *topology_view_, bag, warn,
      [this](const softbody_msgs::MeshTopology& message, const rosbag::MessageInstance& instance) {
        FollowedSurface(name_).setTopology(fromMessage(message));
        topologies_[message.revision] = std::make_shared<const rosbag::MessageInstance>(instance);
      });
  forEachUsable<softbody_msgs::MeshState>(
      *state_view_, bag, warn,
      [this](const softbody_msgs::MeshState& message, const rosbag::MessageInstance& instance) {
        fromMessage(message);
        states_.push_back({toNanoseconds(message.header.stamp), message.revision,
                           withoutSlash(message.header.frame_id),
                           std::make_shared<const rosbag::MessageInstance>(instance)});
      });
  if (topologies_.empty() || states_.empty())
    throw std::invalid_argument(fmt::format(
        "{}: no usable message on {}/{}; --known-surfaces needs the namespace of a surface's topics "
        "in the bag, e.g. /doll/surface",
        bag.getFileName(), name_, topologies_.empty() ? "topology" : "state"));
  std::stable_sort(states_.begin(), states_.end(),
                   [](const Entry& a, const Entry& b) { return a.stamp < b.stamp; });
}

std::optional<KnownSurface> RecordedSurface::at(const RgbdFrame& frame, const std::string& camera_frame,
                                                const BagTransforms& transforms, const Warn& warn) {
  const auto end =
      std::upper_bound(states_.begin(), states_.end(), frame.stamp,
                       [](Nanoseconds stamp, const Entry& state) { return stamp < state.stamp; });
  follow(static_cast<std::size_t>(end - states_.begin()));
  if (next_ == 0) return std::nullopt;
  const std::string& states_frame = states_[next_ - 1].frame_id;
  try {
    const bool same = states_frame == camera_frame;
    return surface_.at(frame.stamp, same ? Eigen::Isometry3d::Identity()
                                         : transforms.at(camera_frame, states_frame, toTime(frame.stamp)));
  } catch (const tf2::TransformException& error) {
    if (!std::exchange(warned_, true))
      warn(fmt::format("{} is left out while tf does not say where it is: {}", name_, error.what()));
    return std::nullopt;
  }
}

/// Gives the surface the states up to an end. Where time has jumped back, it starts again.
void RecordedSurface::follow(std::size_t end) {
  if (end < next_) surface_.forgetStates(), next_ = 0;
  for (; next_ < end; ++next_) {
    const Entry& state = states_[next_];
    const auto topology = topologies_.find(state.revision);
    if (topology == topologies_.end()) continue;
    try {
      if (revision_ != state.revision) {
        surface_.setTopology(fromMessage(*topology->second->instantiate<softbody_msgs::MeshTopology>()));
        revision_ = state.revision;
      }
      MeshState mesh = fromMessage(*state.message->instantiate<softbody_msgs::MeshState>());
      mesh.observed = state.stamp;
      surface_.addState(mesh);
    } catch (const std::invalid_argument&) {
      continue;  // another number of vertices than its topology
    }
  }
}

}  // namespace softbody
