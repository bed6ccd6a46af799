#pragma once

#include <ros/ros.h>

#include "nodes/simulator/surroundings_tracker.h"
#include "softbody_common/ros/node_diagnostics.h"
#include "softbody_sim/dynamics/simulator.h"

namespace softbody {

/// Diagnostics of the simulation, once a second.
class SimulatorDiagnostics {
 public:
  /// @param simulator, surroundings outlive this.
  SimulatorDiagnostics(const ros::NodeHandle& node, const ros::NodeHandle& private_node,
                       const Simulator* simulator, const SurroundingsTracker* surroundings);

  void countStep();
  void countRefusedMessage() { ++refused_; }
  /// @param dropped messages since the start that were not used because newer ones had come.
  void setDropped(int dropped) { dropped_ = dropped; }

 private:
  void summarize(const SurroundingsFollower::Faults& faults, NodeDiagnostics::Status* status) const;
  void report(NodeDiagnostics::Status* status);

  const Simulator* simulator_;
  const SurroundingsTracker* surroundings_;
  int steps_ = 0, steps_not_converged_ = 0, refused_ = 0;  ///< since the last report
  int dropped_ = 0;
  NodeDiagnostics diagnostics_;
};

}  // namespace softbody
