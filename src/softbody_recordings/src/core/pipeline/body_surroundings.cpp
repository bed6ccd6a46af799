#include "softbody_recordings/pipeline/body_surroundings.h"

#include <fmt/format.h>

#include <stdexcept>
#include <utility>

namespace softbody {

BodySurroundings::BodySurroundings(const SurroundingsConfig& config, const std::vector<PinRegion>& pins,
                                   const BodySurface& surface, const TetTopology& volume)
    : gripper_(config.gripper), follower_(config.pin_accuracy_m, surface) {
  for (const ObstacleDescription& obstacle : config.obstacles) follower_.setObstacle(obstacle);
  for (const PinRegion& pin : pins) follower_.addPin(pin, volume);
}

const Surroundings& BodySurroundings::before(Nanoseconds stamp, const SurroundingsInput& input,
                                             const Simulator& simulator, const TargetSet& targets) {
  if (gripper_) followGripper(input, simulator);
  if (!targets.reset)
    return follower_.surroundingsAt(stamp, input.lookup, simulator.state().vertices, simulator.stamp());
  follower_.forgetPinPositions();
  return follower_.surroundingsAt(stamp, input.lookup, verticesToHold(targets, simulator), stamp);
}

/// Only a change counts.
void BodySurroundings::followGripper(const SurroundingsInput& input, const Simulator& simulator) {
  if (!input.gripper_closed || said_closed_ == input.gripper_closed) return;
  said_closed_ = input.gripper_closed;
  if (!*said_closed_) {
    follower_.removePin(gripper_->name);
    return;
  }
  try {
    follower_.grip(*gripper_, input.lookup, simulator.topology(),
                   simulator.placed() ? simulator.state().vertices : Points(), simulator.stamp());
  } catch (const std::invalid_argument& error) {
    log_.push_back(fmt::format("the gripper closes: {}", error.what()));
  }
}

void BodySurroundings::findConflicts(const std::vector<Target>& targets, const Simulator& simulator) {
  follower_.findConflicts(targets, simulator.topology().tets, simulator.state().vertices);
}

void BodySurroundings::update(const Simulator& simulator) {
  follower_.updatePins(simulator.topology(), simulator.state().vertices);
}

std::vector<std::string> BodySurroundings::takeLog() {
  for (const LogLine& line : follower_.takeLog()) log_.push_back(line.text);
  return std::exchange(log_, {});
}

}  // namespace softbody
