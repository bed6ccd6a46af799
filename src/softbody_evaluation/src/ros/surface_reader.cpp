#include "softbody_evaluation/ros/surface_reader.h"

#include <fmt/format.h>
#include <softbody_msgs/MeshState.h>
#include <softbody_msgs/MeshTopology.h>

#include <stdexcept>
#include <utility>

#include "ros/typed_topic.h"
#include "softbody_common/ros/conversions.h"
#include "softbody_common/time/timeline.h"
#include "softbody_recordings/ros/input_bag.h"

namespace softbody::evaluation {
namespace {

std::map<std::uint32_t, MeshTopology> readTopologies(const rosbag::Bag& bag, const std::string& topic) {
  std::map<std::uint32_t, MeshTopology> topologies;
  rosbag::View view(bag, rosbag::TopicQuery(topic));
  for (const rosbag::MessageInstance& instance : view) {
    const auto message = instantiate<softbody_msgs::MeshTopology>(instance, bag);
    if (topologies.count(message->revision) != 0) continue;  // latched messages are repeated
    try {
      topologies[message->revision] = fromMessage(*message);
    } catch (const std::invalid_argument& error) {
      throw std::invalid_argument(fmt::format("{}: {} of revision {}: {}", bag.getFileName(), topic,
                                              message->revision, error.what()));
    }
  }
  return topologies;
}

void requireOneFrame(const rosbag::Bag& bag, const std::string& topic, const std::string& frame_id,
                     const SurfaceRecord& record) {
  if (record.states.empty() || record.frame_id == frame_id) return;
  throw std::invalid_argument(fmt::format("{}: states on {} are in two frames, '{}' and '{}'",
                                          bag.getFileName(), topic, record.frame_id, frame_id));
}

/// @throw std::invalid_argument if the topology is missing, or a value is not finite.
MeshState usableState(const softbody_msgs::MeshState& message,
                      const std::map<std::uint32_t, MeshTopology>& topologies) {
  const auto topology = topologies.find(message.revision);
  if (topology == topologies.end())
    throw std::invalid_argument(fmt::format("the topology of revision {} is missing", message.revision));
  const auto vertices = static_cast<std::size_t>(topology->second.rest_vertices.rows());
  if (message.vertices.size() != vertices) {
    throw std::invalid_argument(fmt::format("it has {} vertices, but the topology of revision {} has {}",
                                            message.vertices.size(), message.revision, vertices));
  }
  return fromMessage(message);
}

}  // namespace

SurfaceRecord readSurface(const std::string& path, const std::string& topology_topic,
                          const std::string& state_topic) try {
  const rosbag::Bag bag = openBag(path);
  requireTopic(bag, topology_topic);
  requireTopic(bag, state_topic);
  SurfaceRecord record;
  record.topologies = readTopologies(bag, topology_topic);
  std::size_t left_out = 0;
  std::string reason;
  Timeline timeline;
  rosbag::View states(bag, rosbag::TopicQuery(state_topic));
  for (const rosbag::MessageInstance& instance : states) {
    const auto message = instantiate<softbody_msgs::MeshState>(instance, bag);
    requireOneFrame(bag, state_topic, message->header.frame_id, record);
    record.frame_id = message->header.frame_id;
    try {
      MeshState state = usableState(*message, record.topologies);
      const Nanoseconds stamp = toNanoseconds(message->header.stamp);
      const StampVerdict verdict = timeline.judge(stamp, toNanoseconds(instance.getTime()));
      if (!verdict.acceptedOrSame()) throw std::invalid_argument(whyRefused(verdict));
      record.states[stamp] = std::move(state);
    } catch (const std::invalid_argument& error) {
      if (left_out++ == 0)
        reason = fmt::format("at {:.3f} s {}", message->header.stamp.toSec(), error.what());
    }
  }
  const std::string note = fmt::format("{}: {} of {} states on {} are not usable: {}", path, left_out,
                                       states.size(), state_topic, reason);
  if (record.states.empty()) throw std::invalid_argument(note);
  if (left_out > 0) record.notes.push_back(note);
  return record;
} catch (const rosbag::BagException& error) {
  throw damagedBag(path, error);
}

}  // namespace softbody::evaluation
