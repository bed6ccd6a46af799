#pragma once

#include <optional>
#include <string>
#include <vector>

#include "softbody_sim/dynamics/simulator.h"
#include "softbody_sim/surroundings/surroundings_config.h"
#include "softbody_sim/surroundings/surroundings_follower.h"

namespace softbody {

/// What is known of a body's surroundings at a frame.
struct SurroundingsInput {
  FrameLookup lookup = [](const std::string&, Nanoseconds) { return std::nullopt; };  ///< in the fixed frame
  std::optional<bool> gripper_closed;  ///< the last that was said of the gripper; empty: nothing yet
};

/// Pins, gripper and obstacles of a body, step by step, as in the simulator node.
class BodySurroundings {
 public:
  /// @param pins held from the start. @param surface, volume the uncut body. @throw std::invalid_argument as
  /// SurroundingsFollower does.
  BodySurroundings(const SurroundingsConfig& config, const std::vector<PinRegion>& pins,
                   const BodySurface& surface, const TetTopology& volume);

  /// What acts in the step to a stamp. @param simulator before the step. @param targets of the step.
  const Surroundings& before(Nanoseconds stamp, const SurroundingsInput& input, const Simulator& simulator,
                             const TargetSet& targets);
  const Surroundings& last() const { return follower_.lastSurroundings().all; }
  void findConflicts(const std::vector<Target>& targets, const Simulator& simulator);
  std::vector<NamedReaction> named(const Reactions& reactions) const { return follower_.named(reactions); }

  /// After a cut.
  void update(const Simulator& simulator);
  /// The body is uncut again, and not placed.
  void restart(const TetTopology& volume) { follower_.updatePins(volume, {}); }

  /// Warnings and notes since the last call.
  std::vector<std::string> takeLog();

 private:
  void followGripper(const SurroundingsInput& input, const Simulator& simulator);

  std::optional<PinRegion> gripper_;
  std::optional<bool> said_closed_;  ///< of the gripper
  SurroundingsFollower follower_;
  std::vector<std::string> log_;
};

}  // namespace softbody
