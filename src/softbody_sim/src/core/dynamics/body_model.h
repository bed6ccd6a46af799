#pragma once

#include <memory>

#include "dynamics/occluded_piece_damping.h"
#include "dynamics/vertex_confidence.h"
#include "elasticity/tet_materials.h"
#include "estimation/load_estimator.h"
#include "estimation/shape_memory.h"
#include "forces/force_estimator.h"
#include "softbody_sim/dynamics/simulator.h"
#include "time_step/constrained_step.h"
#include "time_step/free_motion.h"
#include "time_step/step_solver.h"

namespace softbody {

/// Everything that is computed once per topology of the volume.
struct BodyModel {
  /// @param edge_length mean of the uncut body [m]: the unit of length for targets, contact and tolerances.
  /// @throw std::invalid_argument if topology, material or config do not describe a body.
  BodyModel(TetTopology topology_in, const Material& material, const SimulatorConfig& config,
            double edge_length);

  /// Whether the topology is that of the model, up to its revision.
  bool hasTets(const TetTopology& other) const;
  /// Made when it is needed.
  ForceEstimator& forceEstimator(Elasticity elasticity);

  TetTopology topology;
  const TetMaterials materials;
  const Eigen::VectorXd masses;  ///< lumped [kg]
  const FreeMotion free_motion;
  const double target_stiffness;  ///< of a target of weight 1 [N/m]
  const std::unique_ptr<StepSolver> solver;
  ConstrainedStep constrained_step;
  VertexConfidence vertex_confidence;
  LoadEstimator load_estimator;
  const ShapeMemory shape_memory;
  OccludedPieceDamping occluded_piece_damping;

 private:
  const double edge_length_;
  std::unique_ptr<ForceEstimator> force_estimator_;
};

}  // namespace softbody
