#include "softbody_sim/surroundings/surroundings_follower.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "constraints/pin_conflict.h"
#include "softbody_common/geometry/rigid_fit.h"
#include "softbody_common/protocol/target_limits.h"

namespace softbody {
namespace {

// The time of a step grows with both.
constexpr std::size_t kMostPins = 1000;
constexpr std::size_t kMostObstacles = 1000;

std::string gripsNothing(const PinRegion& region) {
  return fmt::format(
      "pin '{}' holds nothing: nothing of the body is in its box in frame '{}' ([{:.3g}, {:.3g}, {:.3g}] "
      "to "
      "[{:.3g}, {:.3g}, {:.3g}] m); check that the body is tracked, and the box in rviz",
      region.name, region.frame, region.min.x(), region.min.y(), region.min.z(), region.max.x(),
      region.max.y(), region.max.z());
}

/// A wrench in a frame, about the frame's origin. @param about_origin of the targets' frame.
Wrench inFrame(const Eigen::Isometry3d& frame_pose, const Wrench& about_origin) {
  const Eigen::Matrix3d to_frame = frame_pose.linear().transpose();
  return {to_frame * about_origin.force,
          to_frame * (about_origin.torque - frame_pose.translation().cross(about_origin.force))};
}

FollowedFrame frameOf(const ObstacleDescription& description) {
  return {fmt::format("obstacle '{}'", description.name), description.frame};
}

}  // namespace

SurroundingsFollower::PlacedObstacle* SurroundingsFollower::find(const std::string& obstacle) {
  const auto found = std::find_if(obstacles_.begin(), obstacles_.end(), [&](const PlacedObstacle& placed) {
    return placed.description.name == obstacle;
  });
  return found == obstacles_.end() ? nullptr : &*found;
}

void SurroundingsFollower::setObstacle(ObstacleDescription description) {
  if (pins_.count(description.name) > 0)
    throw std::invalid_argument(fmt::format("obstacle '{}' has the name of a pin", description.name));
  PlacedObstacle* known = find(description.name);
  if (!known && obstacles_.size() >= kMostObstacles)
    throw std::invalid_argument(
        fmt::format("there are {} obstacles already: remove one first", obstacles_.size()));
  PlacedObstacle placed{description, frameOf(description)};
  if (known)
    *known = std::move(placed);
  else
    obstacles_.push_back(std::move(placed));
  obstacles_changed_ = true;
}

bool SurroundingsFollower::moveObstacle(const std::string& name, const std::string& frame,
                                        const Eigen::Isometry3d& pose) {
  PlacedObstacle* known = find(name);
  if (!known) return false;
  ObstacleDescription& description = known->description;
  description.shape.pose = pose;
  if (std::exchange(description.frame, frame) != frame) known->frame = frameOf(description);
  return true;
}

bool SurroundingsFollower::removeObstacle(const std::string& name) {
  const PlacedObstacle* known = find(name);
  if (!known) return false;
  obstacles_.erase(obstacles_.begin() + (known - obstacles_.data()));
  obstacles_changed_ = true;
  return true;
}

std::vector<std::string> SurroundingsFollower::pinNames() const {
  std::vector<std::string> names;
  for (const auto& entry : pins_) names.push_back(entry.first);
  return names;
}

std::vector<std::string> SurroundingsFollower::obstacleNames() const {
  std::vector<std::string> names;
  for (const PlacedObstacle& obstacle : obstacles_) names.push_back(obstacle.description.name);
  return names;
}

const FollowedFrame* SurroundingsFollower::followedBy(const std::string& name) const {
  const auto pin = pins_.find(name);
  if (pin != pins_.end()) return &pin->second.frame;
  for (const PlacedObstacle& obstacle : obstacles_)
    if (obstacle.description.name == name) return &obstacle.frame;
  return nullptr;
}

std::string SurroundingsFollower::reportUnknownFrame(const std::string& name) {
  const auto pin = pins_.find(name);
  PlacedObstacle* obstacle = find(name);
  FollowedFrame* frame = pin != pins_.end() ? &pin->second.frame : obstacle ? &obstacle->frame : nullptr;
  if (!frame) return {};
  frame->reportUnknown(&log_);
  return frame->fault();
}

std::shared_ptr<const BodySurface> SurroundingsFollower::surfaceIn(const TetTopology& volume) {
  if (!surface_->isIn(volume)) surface_ = std::make_shared<BodySurface>(surface_->in(volume));
  return surface_;
}

std::size_t SurroundingsFollower::addPin(PinRegion region, const TetTopology& volume) {
  requireFree(region.name);
  return insert({std::move(region), *surfaceIn(volume), volume.rest_vertices});
}

std::size_t SurroundingsFollower::grip(PinRegion region, const FrameLookup& lookup, const TetTopology& volume,
                                       const Points& vertices, Nanoseconds stamp) {
  requireFree(region.name);
  const BodySurface& surface = *surfaceIn(volume);
  PinnedVertices held(region, surface, {});
  const auto pose = findFrame(lookup, region.frame, stamp);
  if (pose && vertices.rows() > 0) {
    held.hold(surface, pose->pose, vertices);
    if (held.vertexCount() == 0)
      throw std::invalid_argument(gripsNothing(region) + "; " +
                                  surface.nearestTo(region.box(), pose->pose.inverse(), vertices));
  }
  return insert(std::move(held));
}

void SurroundingsFollower::requireFree(const std::string& pin) {
  requireTopicName(pin);
  if (find(pin)) throw std::invalid_argument(fmt::format("pin '{}' has the name of an obstacle", pin));
  if (pins_.size() >= kMostPins && pins_.count(pin) == 0)
    throw std::invalid_argument(fmt::format("{} pins are held already: release one first", pins_.size()));
}

std::size_t SurroundingsFollower::insert(PinnedVertices held) {
  const PinRegion region = held.region();
  const std::size_t count = held.vertexCount();
  FollowedFrame frame(fmt::format("pin '{}'", region.name), region.frame);
  pins_.insert_or_assign(region.name, HeldPin{std::move(held), std::move(frame), {}});
  return count;
}

bool SurroundingsFollower::removePin(const std::string& name) { return pins_.erase(name) > 0; }

void SurroundingsFollower::replacePins(BodySurface surface, const std::vector<PinRegion>& regions,
                                       const TetTopology& volume) {
  SurroundingsFollower next = *this;
  next.pins_.clear();
  next.surface_ = std::make_shared<BodySurface>(std::move(surface));
  for (const PinRegion& region : regions) next.addPin(region, volume);
  next.updatePins(volume, {});
  *this = std::move(next);
}

void SurroundingsFollower::updatePins(const TetTopology& volume, const Points& vertices) {
  if (!pins_.empty()) surfaceIn(volume);
  surroundings_.all.pins.clear();
  surroundings_.pins.clear();
  for (auto& [name, pin] : pins_) {
    pin.held.updateVertices(*surface_, volume.rest_vertices, vertices);
    if (pin.held.hasPositions()) appendPins(name, pin.held);
  }
}

void SurroundingsFollower::appendPins(const std::string& name, const PinnedVertices& held) {
  if (held.acts()) held.appendPins(pin_accuracy_m_, &surroundings_.all.pins);
  surroundings_.pins.resize(surroundings_.all.pins.size(), name);
}

void SurroundingsFollower::forgetPinPositions() {
  for (auto& entry : pins_) entry.second.held.forgetPositions();
}

const Surroundings& SurroundingsFollower::surroundingsAt(Nanoseconds stamp, const FrameLookup& lookup,
                                                         const Points& vertices, Nanoseconds step) {
  surroundings_ = {};
  surroundings_.all.obstacles_changed = std::exchange(obstacles_changed_, false);
  placeObstacles(stamp, lookup);
  placePins(stamp, lookup, vertices, step);
  return surroundings_.all;
}

void SurroundingsFollower::placeObstacles(Nanoseconds stamp, const FrameLookup& lookup) {
  for (PlacedObstacle& obstacle : obstacles_) {
    obstacle.frame.update(lookup, stamp, &log_);
    if (!obstacle.frame.pose()) continue;
    const Obstacle& shape = obstacle.description.shape;
    surroundings_.all.obstacles.push_back(shape);
    surroundings_.all.obstacles.back().pose = *obstacle.frame.pose() * shape.pose;
    surroundings_.obstacles.push_back(obstacle.description.name);
  }
}

void SurroundingsFollower::placePins(Nanoseconds stamp, const FrameLookup& lookup, const Points& vertices,
                                     Nanoseconds step) {
  for (auto& entry : pins_) {
    PinnedVertices& held = entry.second.held;
    FollowedFrame& frame = entry.second.frame;
    if (!held.hasPositions() && vertices.rows() > 0) {
      const auto found = findFrame(lookup, held.region().frame, step);
      if (found) held.hold(*surface_, found->pose, vertices);
    }
    frame.update(lookup, stamp, &log_);
    held.setFramePose(frame.pose());
    appendPins(entry.first, held);
  }
}

void SurroundingsFollower::findConflicts(const std::vector<Target>& targets, const Tets& tets,
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

/// A pin and the camera are in conflict from three standard deviations of their difference on. The conflict
/// ends at half the size at which it begins, so that noise does not end it.
void SurroundingsFollower::judge(double conflict_m, HeldPin* pin) {
  const std::string& name = pin->held.region().name;
  const double limit_m = 3.0 * std::hypot(pin_accuracy_m_, kTargetAccuracy_m);
  if (conflict_m > limit_m)
    pin->conflict.begin(fmt::format("pin '{}' and the camera disagree by {:.1f} mm: the body is held between "
                                    "them; check the frame's calibration, or whether the pin slips",
                                    name, 1e3 * conflict_m),
                        &log_);
  else if (conflict_m < 0.5 * limit_m)
    pin->conflict.end(fmt::format("pin '{}' and the camera agree again", name), &log_);
}

std::vector<NamedReaction> SurroundingsFollower::named(const Reactions& reactions) const {
  std::vector<NamedReaction> named;
  if (reactions.obstacles.size() == surroundings_.all.obstacles.size()) addObstacles(reactions, &named);
  if (reactions.pins.size() == surroundings_.all.pins.size()) addPins(reactions, &named);
  return named;
}

void SurroundingsFollower::addObstacles(const Reactions& reactions, std::vector<NamedReaction>* named) const {
  std::size_t next = 0;
  for (const PlacedObstacle& obstacle : obstacles_) {
    if (!obstacle.frame.pose()) continue;
    const std::size_t k = next++;
    const Eigen::Vector3d place = surroundings_.all.obstacles[k].pose.translation();
    named->push_back({obstacle.description.name, obstacle.description.frame,
                      inFrame(*obstacle.frame.pose(), aboutOrigin(reactions.obstacles[k], place))});
  }
}

void SurroundingsFollower::addPins(const Reactions& reactions, std::vector<NamedReaction>* named) const {
  std::size_t next = 0;
  for (const auto& [name, pin] : pins_) {
    if (!pin.held.acts()) continue;
    Wrench sum;
    for (std::size_t k = 0; k < pin.held.vertexCount(); ++k, ++next) {
      const Wrench wrench = aboutOrigin(reactions.pins[next], surroundings_.all.pins[next].position);
      sum.force += wrench.force;
      sum.torque += wrench.torque;
    }
    named->push_back({name, pin.held.region().frame, inFrame(pin.held.framePose(), sum)});
  }
}

Points verticesToHold(const TargetSet& targets, const Simulator& simulator) {
  if (simulator.placed()) return {};
  return transformed(simulator.topology().rest_vertices, targets.body_pose);
}

SurroundingsFollower::Faults SurroundingsFollower::faults() const {
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
