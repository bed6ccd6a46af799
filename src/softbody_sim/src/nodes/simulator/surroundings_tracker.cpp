#include "nodes/simulator/surroundings_tracker.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "softbody_common/ros/frame_name.h"
#include "softbody_sim/constraints/pin_conflict.h"

namespace softbody {
namespace {

// The time of a step grows with both.
constexpr std::size_t kMostPins = 1000;
constexpr std::size_t kMostObstacles = 1000;

std::string gripsNothing(const PinRegion& region) {
  return fmt::format(
      "pin '{}' holds nothing: no vertex of the body is in its box in frame '{}' ([{:.3g}, {:.3g}, {:.3g}] "
      "to "
      "[{:.3g}, {:.3g}, {:.3g}] m); check that the body is tracked, and the box in rviz",
      region.name, region.frame, region.min.x(), region.min.y(), region.min.z(), region.max.x(),
      region.max.y(), region.max.z());
}

}  // namespace

SurroundingsTracker::SurroundingsTracker(const ros::NodeHandle& node,
                                         const std::vector<ObstacleDescription>& obstacles,
                                         const PinOptions& options)
    : node_(node), options_(options) {
  for (const ObstacleDescription& obstacle : obstacles) setObstacle(obstacle);
}

FollowedFrame SurroundingsTracker::frameOf(const ObstacleDescription& description) const {
  return {fmt::format("obstacle '{}'", description.name), description.frame, options_.frame_timeout_s};
}

SurroundingsTracker::PlacedObstacle* SurroundingsTracker::find(const std::string& obstacle) {
  const auto found = std::find_if(obstacles_.begin(), obstacles_.end(), [&](const PlacedObstacle& placed) {
    return placed.description.name == obstacle;
  });
  return found == obstacles_.end() ? nullptr : &*found;
}

void SurroundingsTracker::setObstacle(ObstacleDescription description) {
  description.frame = frameName(description.frame, fmt::format("obstacle '{}'", description.name));
  if (pins_.count(description.name) > 0)
    throw std::invalid_argument(fmt::format("obstacle '{}' has the name of a pin", description.name));
  PlacedObstacle* known = find(description.name);
  if (!known && obstacles_.size() >= kMostObstacles)
    throw std::invalid_argument(
        fmt::format("there are {} obstacles already: remove one first", obstacles_.size()));
  PlacedObstacle placed{description, frameOf(description), ReactionPublisher(node_, description.name)};
  if (known)
    *known = std::move(placed);
  else
    obstacles_.push_back(std::move(placed));
  obstacles_changed_ = true;
}

bool SurroundingsTracker::moveObstacle(const std::string& name, const std::string& given_frame,
                                       const Eigen::Isometry3d& pose) {
  const std::string frame = frameName(given_frame, fmt::format("obstacle '{}'", name));
  PlacedObstacle* known = find(name);
  if (!known) return false;
  ObstacleDescription& description = known->description;
  description.shape.pose = pose;
  if (std::exchange(description.frame, frame) != frame) known->frame = frameOf(description);
  return true;
}

bool SurroundingsTracker::removeObstacle(const std::string& name) {
  const PlacedObstacle* known = find(name);
  if (!known) return false;
  obstacles_.erase(obstacles_.begin() + (known - obstacles_.data()));
  obstacles_changed_ = true;
  return true;
}

std::string SurroundingsTracker::waitingForFrame(const std::string& name) {
  const auto judge = [&](const std::string& frame_name, FollowedFrame* frame) -> std::string {
    if (poses_.knows(frame_name, frame_)) return {};
    frame->reportUnknown();
    return frame->fault();
  };
  if (PlacedObstacle* obstacle = find(name)) return judge(obstacle->description.frame, &obstacle->frame);
  const auto pin = pins_.find(name);
  return pin == pins_.end() ? "" : judge(pin->second.held.region().frame, &pin->second.frame);
}

std::vector<std::string> SurroundingsTracker::names() const {
  std::vector<std::string> names;
  for (const auto& entry : pins_) names.push_back(entry.first);
  for (const PlacedObstacle& obstacle : obstacles_) names.push_back(obstacle.description.name);
  return names;
}

std::size_t SurroundingsTracker::addPin(PinRegion region, const Points& rest_vertices) {
  requireFree(region.name);
  region.frame = frameName(region.frame, fmt::format("pin '{}'", region.name));
  return insert({std::move(region), rest_vertices});
}

std::size_t SurroundingsTracker::grip(PinRegion region, const Points& vertices) {
  requireFree(region.name);
  region.frame = frameName(region.frame, fmt::format("pin '{}'", region.name));
  HeldRegion held(region, {});
  const auto pose = poses_.find(region.frame, frame_, step_stamp_);
  if (pose && vertices.rows() > 0) {
    held.hold(pose->pose, vertices);
    if (held.vertexCount() == 0) throw std::invalid_argument(gripsNothing(region));
  }
  return insert(std::move(held));
}

void SurroundingsTracker::requireFree(const std::string& pin) {
  requireTopicName(pin);
  if (find(pin)) throw std::invalid_argument(fmt::format("pin '{}' has the name of an obstacle", pin));
  if (pins_.size() >= kMostPins && pins_.count(pin) == 0)
    throw std::invalid_argument(fmt::format("{} pins are held already: release one first", pins_.size()));
}

std::size_t SurroundingsTracker::insert(HeldRegion held) {
  const PinRegion region = held.region();
  const std::size_t count = held.vertexCount();
  FollowedFrame frame(fmt::format("pin '{}'", region.name), region.frame, options_.frame_timeout_s);
  pins_.insert_or_assign(
      region.name, HeldPin{std::move(held), std::move(frame), ReactionPublisher(node_, region.name), {}});
  return count;
}

bool SurroundingsTracker::removePin(const std::string& name) { return pins_.erase(name) > 0; }

void SurroundingsTracker::updatePins(const Points& rest_vertices, const Points& vertices) {
  surroundings_.all.pins.clear();
  surroundings_.pins.clear();
  for (auto& [name, pin] : pins_) {
    pin.held.updateVertices(rest_vertices, vertices);
    if (pin.held.hasPositions()) appendPins(name, pin.held);
  }
}

void SurroundingsTracker::appendPins(const std::string& name, const HeldRegion& held) {
  if (held.acts()) held.appendPins(options_.accuracy_m, &surroundings_.all.pins);
  surroundings_.pins.resize(surroundings_.all.pins.size(), name);
}

void SurroundingsTracker::forgetPinPositions() {
  for (auto& entry : pins_) entry.second.held.forgetPositions();
}

const Surroundings& SurroundingsTracker::surroundingsAt(const std::string& frame, const ros::Time& stamp,
                                                        const Points& vertices) {
  frame_ = frame;
  surroundings_ = {};
  surroundings_.all.obstacles_changed = std::exchange(obstacles_changed_, false);
  placeObstacles(stamp);
  placePins(stamp, vertices);
  return surroundings_.all;
}

void SurroundingsTracker::placeObstacles(const ros::Time& stamp) {
  for (PlacedObstacle& obstacle : obstacles_) {
    obstacle.frame.update(poses_, frame_, stamp);
    if (!obstacle.frame.pose()) continue;
    const Obstacle& shape = obstacle.description.shape;
    surroundings_.all.obstacles.push_back(shape);
    surroundings_.all.obstacles.back().pose = *obstacle.frame.pose() * shape.pose;
    surroundings_.obstacles.push_back(obstacle.description.name);
  }
}

void SurroundingsTracker::placePins(const ros::Time& stamp, const Points& vertices) {
  for (auto& entry : pins_) {
    HeldRegion& held = entry.second.held;
    FollowedFrame& frame = entry.second.frame;
    if (!held.hasPositions() && vertices.rows() > 0) {
      const auto found =
          poses_.find(held.region().frame, frame_, step_stamp_);  // the vertices are of that stamp
      if (found) held.hold(found->pose, vertices);
    }
    frame.update(poses_, frame_, stamp);
    held.setFramePose(frame.pose());
    appendPins(entry.first, held);
  }
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
  auto next = surroundings_.all.pins.cbegin();
  for (auto& entry : pins_) {
    HeldPin& pin = entry.second;
    if (!pin.held.acts()) continue;
    const auto end = next + static_cast<std::ptrdiff_t>(pin.held.vertexCount());
    judge(pinConflict(targets, tets, vertices, {next, end}), &pin);
    next = end;
  }
}

/// A conflict ends at half the size at which it begins, so that noise does not end it.
void SurroundingsTracker::judge(double conflict_m, HeldPin* pin) const {
  const std::string& name = pin->held.region().name;
  if (conflict_m > options_.conflict_m)
    pin->conflict.begin(
        fmt::format("pin '{}' and the camera disagree by {:.1f} mm: the body is held between "
                    "them; check the frame's calibration, or whether the pin slips",
                    name, 1e3 * conflict_m));
  else if (conflict_m < 0.5 * options_.conflict_m)
    pin->conflict.end(fmt::format("pin '{}' and the camera agree again", name));
}

bool SurroundingsTracker::hasListenedPins() const {
  return std::any_of(pins_.begin(), pins_.end(),
                     [](const auto& entry) { return entry.second.reaction.isListenedTo(); });
}

void SurroundingsTracker::publishReactions(const Reactions& reactions, const ros::Time& stamp) {
  step_stamp_ = stamp;
  if (reactions.obstacles.size() != surroundings_.all.obstacles.size() ||
      reactions.pins.size() != surroundings_.all.pins.size())
    return;
  publishObstacles(reactions, stamp);
  publishPins(reactions, stamp);
}

void SurroundingsTracker::publishObstacles(const Reactions& reactions, const ros::Time& stamp) {
  std::size_t next = 0;
  for (const PlacedObstacle& obstacle : obstacles_) {
    if (!obstacle.frame.pose()) continue;
    const std::size_t k = next++;
    obstacle.reaction.publish(
        orTargetFrame(obstacle.description.frame), *obstacle.frame.pose(),
        aboutOrigin(reactions.obstacles[k], surroundings_.all.obstacles[k].pose.translation()), stamp);
  }
}

void SurroundingsTracker::publishPins(const Reactions& reactions, const ros::Time& stamp) {
  std::size_t next = 0;
  for (const auto& entry : pins_) {
    const HeldRegion& held = entry.second.held;
    if (!held.acts()) continue;
    Wrench sum;
    for (std::size_t k = 0; k < held.vertexCount(); ++k, ++next) {
      const Wrench wrench = aboutOrigin(reactions.pins[next], surroundings_.all.pins[next].position);
      sum.force += wrench.force;
      sum.torque += wrench.torque;
    }
    entry.second.reaction.publish(orTargetFrame(held.region().frame), held.framePose(), sum, stamp);
  }
}

SurroundingsTracker::Faults SurroundingsTracker::faults() const {
  Faults faults;
  for (const PlacedObstacle& obstacle : obstacles_)
    faults.emplace_back(obstacle.description.name, obstacle.frame.fault());
  for (const auto& [name, pin] : pins_) {
    faults.emplace_back(name, pin.frame.fault());
    faults.emplace_back(name, pin.conflict.sentence());
    if (pin.held.hasPositions() && pin.held.vertexCount() == 0)
      faults.emplace_back(name, gripsNothing(pin.held.region()));
  }
  faults.erase(std::remove_if(faults.begin(), faults.end(), [](const auto& f) { return f.second.empty(); }),
               faults.end());
  return faults;
}

}  // namespace softbody
