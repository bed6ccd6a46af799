#include "nodes/simulator/surroundings_tracker.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "softbody_common/ros/frame_name.h"
#include "softbody_common/ros/time.h"

namespace softbody {
namespace {

std::string pinFrame(const PinRegion& region) {
  return frameName(region.frame, fmt::format("pin '{}'", region.name));
}

std::string obstacleFrame(const std::string& frame, const std::string& name) {
  return frameName(frame, fmt::format("obstacle '{}'", name));
}

}  // namespace

SurroundingsTracker::SurroundingsTracker(const ros::NodeHandle& node, const SurroundingsConfig& config,
                                         BodySurface surface)
    : node_(node), follower_(config.pin_accuracy_m, std::move(surface)) {
  for (const ObstacleDescription& obstacle : config.obstacles) setObstacle(obstacle);
}

FrameLookup SurroundingsTracker::lookup() const {
  return [this](const std::string& frame, Nanoseconds stamp) {
    return poses_.find(frame, frame_, toTime(stamp));
  };
}

void SurroundingsTracker::writeLog() {
  for (const LogLine& line : follower_.takeLog()) {
    if (line.is_warning)
      ROS_WARN_STREAM(line.text);
    else
      ROS_INFO_STREAM(line.text);
  }
}

std::size_t SurroundingsTracker::addPin(PinRegion region, const TetTopology& volume) {
  const std::string name = region.name;
  region.frame = pinFrame(region);
  const std::size_t count = follower_.addPin(std::move(region), volume);
  publishers_.try_emplace(name, node_, name);
  return count;
}

std::size_t SurroundingsTracker::grip(PinRegion region, const TetTopology& volume, const Points& vertices) {
  const std::string name = region.name;
  region.frame = pinFrame(region);
  const std::size_t count =
      follower_.grip(std::move(region), lookup(), volume, vertices, toNanoseconds(step_stamp_));
  publishers_.try_emplace(name, node_, name);
  return count;
}

bool SurroundingsTracker::removePin(const std::string& name) {
  return follower_.removePin(name) && publishers_.erase(name) > 0;
}

void SurroundingsTracker::replacePins(BodySurface surface, std::vector<PinRegion> regions,
                                      const TetTopology& volume) {
  for (PinRegion& region : regions) region.frame = pinFrame(region);
  const std::vector<std::string> before = follower_.pinNames();
  follower_.replacePins(std::move(surface), regions, volume);
  for (const std::string& name : before) publishers_.erase(name);
  for (const std::string& name : follower_.pinNames()) publishers_.try_emplace(name, node_, name);
}

void SurroundingsTracker::setObstacle(ObstacleDescription description) {
  const std::string name = description.name;
  description.frame = obstacleFrame(description.frame, name);
  follower_.setObstacle(std::move(description));
  publishers_.try_emplace(name, node_, name);
}

bool SurroundingsTracker::moveObstacle(const std::string& name, const std::string& frame,
                                       const Eigen::Isometry3d& pose) {
  return follower_.moveObstacle(name, obstacleFrame(frame, name), pose);
}

bool SurroundingsTracker::removeObstacle(const std::string& name) {
  return follower_.removeObstacle(name) && publishers_.erase(name) > 0;
}

std::string SurroundingsTracker::waitingForFrame(const std::string& name) {
  const FollowedFrame* followed = follower_.followedBy(name);
  if (!followed || poses_.knows(followed->frame(), frame_)) return {};
  const std::string fault = follower_.reportUnknownFrame(name);
  writeLog();
  return fault;
}

std::vector<std::string> SurroundingsTracker::names() const {
  std::vector<std::string> names = follower_.pinNames();
  const std::vector<std::string> obstacles = follower_.obstacleNames();
  names.insert(names.end(), obstacles.begin(), obstacles.end());
  return names;
}

const Surroundings& SurroundingsTracker::surroundingsAt(const std::string& frame, const ros::Time& stamp,
                                                        const Points& vertices,
                                                        const ros::Time& vertices_stamp) {
  frame_ = frame;
  const Surroundings& surroundings =
      follower_.surroundingsAt(toNanoseconds(stamp), lookup(), vertices, toNanoseconds(vertices_stamp));
  writeLog();
  return surroundings;
}

std::map<std::string, Eigen::Isometry3d> SurroundingsTracker::posesOf(
    const std::set<std::string>& frames) const {
  std::map<std::string, Eigen::Isometry3d> poses;
  for (const std::string& frame : frames) {
    const auto pose = poseOf(frame, step_stamp_);
    if (pose) poses.emplace(frame, *pose);
  }
  return poses;
}

std::optional<Eigen::Isometry3d> SurroundingsTracker::poseOf(const std::string& frame,
                                                             const ros::Time& stamp) const {
  const auto found = poses_.find(frame, frame_, stamp);
  if (!found) return std::nullopt;
  return found->pose;
}

void SurroundingsTracker::findConflicts(const std::vector<Target>& targets, const Tets& tets,
                                        const Points& vertices) {
  follower_.findConflicts(targets, tets, vertices);
  writeLog();
}

bool SurroundingsTracker::hasListenedPins() const {
  const std::vector<std::string> pins = follower_.pinNames();
  return std::any_of(pins.begin(), pins.end(),
                     [&](const std::string& pin) { return publishers_.at(pin).isListenedTo(); });
}

void SurroundingsTracker::publishReactions(const Reactions& reactions, const ros::Time& stamp) {
  step_stamp_ = stamp;
  for (const NamedReaction& reaction : follower_.named(reactions))
    publishers_.at(reaction.name).publish(reaction, frame_, stamp);
}

}  // namespace softbody
