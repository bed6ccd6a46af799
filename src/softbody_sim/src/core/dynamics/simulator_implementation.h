#pragma once

#include <memory>
#include <vector>

#include "cutting/volume/recent_edits.h"
#include "dynamics/body_model.h"
#include "dynamics/body_state.h"
#include "dynamics/implicit_euler.h"
#include "softbody_sim/dynamics/simulator.h"

namespace softbody {

/// What a Simulator is made of, and the parts of its steps.
struct Simulator::Implementation {
  Implementation(const TetTopology& topology, const Material& material_in, const SimulatorConfig& config_in);

  void setTopology(const TetTopology& topology);
  void makeModel(const TetTopology& topology, const Material& next_material,
                 const SimulatorConfig& next_config);
  /// The targets for the present revision. @param storage holds them if they were for an earlier one.
  const TargetSet& toCurrentRevision(const TargetSet& targets, TargetSet* storage) const;
  void requireUsable(const TargetSet& targets, const Surroundings& surroundings) const;
  void place(const Eigen::Isometry3d& pose, Nanoseconds stamp);
  void advance(const std::vector<Target>& targets, Nanoseconds stamp, const Surroundings& surroundings);
  /// Loads, confidence and standard deviation after a step with these targets.
  void estimate(const std::vector<Target>& targets, const Surroundings& surroundings, double elapsed_s);

  const TetTopology uncut;
  Material material;
  SimulatorConfig config;
  const double edge_length;  ///< mean, of the uncut body [m]

  RecentEdits recent;
  std::unique_ptr<BodyModel> model;
  BodyState body;
  BodyState next;  ///< of a step that may still fail

  ImplicitEuler integrator;
};

}  // namespace softbody
