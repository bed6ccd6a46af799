#pragma once

#include <diagnostic_updater/diagnostic_updater.h>
#include <ros/ros.h>

#include "softbody_sim/dynamics/simulator.h"

namespace softbody {

/// Diagnostics of the simulation, once a second.
class SimulatorDiagnostics {
 public:
  /// @param simulator outlives this.
  SimulatorDiagnostics(const ros::NodeHandle& node, const ros::NodeHandle& private_node,
                       const Simulator* simulator);

  void countStep();
  void countRefusedMessage() { ++refused_; }

 private:
  void summarize(diagnostic_updater::DiagnosticStatusWrapper* status) const;
  void report(diagnostic_updater::DiagnosticStatusWrapper* status);

  const Simulator* simulator_;
  int steps_ = 0, steps_not_converged_ = 0, refused_ = 0;  ///< since the last report
  diagnostic_updater::Updater updater_;
  ros::WallTimer timer_;
};

}  // namespace softbody
