#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <vector>

#include "constraints/target_energy.h"
#include "elasticity/tet_materials.h"
#include "estimation/deformation_modes.h"
#include "estimation/load_estimate.h"
#include "estimation/turned_modes.h"
#include "softbody_common/types.h"
#include "softbody_sim/constraints/surroundings.h"
#include "tets/block_tet_matrix.h"

namespace softbody {

/// Estimates the unknown external loads on an observed body that is in balance under them, and where the body
/// may be: the most probable loads f along the modes of
///
///   1/2 (f - a f')^T C^-1 (f - a f') + sum of weight / (2 accuracy^2) (target - S x(f))^2
///
/// The prior is the last estimate f'. It fades, a = exp(-dt / fade), and its covariance C grows to that of
/// loads of which nothing is known (a Kalman filter of an Ornstein-Uhlenbeck process). The low modes move the
/// body most, so they explain first what is seen: they bend, twist and stretch whole sections, also where
/// nothing is seen. The body moves linearly around its present shape. Where the body may be follows from the
/// inverse Hessian of this energy, for loads that are as large as those that are found.
///
/// On each connected piece the loads have no net force or torque: only the springs of the targets move a
/// piece rigidly, so an occluded body stays in place. A piece that a pin holds gets no new loads: there the
/// springs also carry the force with which the pin contradicts the camera.
class LoadEstimator {
 public:
  struct Options {
    double fade_s = 0.0;             ///< time in which what is known of loads falls to 1/e; above 0
    double target_stiffness = 0.0;   ///< of a target of weight 1 [N/m]
    double target_accuracy_m = 0.0;  ///< its standard deviation
  };

  /// @param topology, @param materials outlive this. @param masses lumped, #V [kg].
  LoadEstimator(const TetTopology& topology, const TetMaterials& materials, const Eigen::VectorXd& masses,
                const Options& options);

  /// Makes the modes, which takes longer than a step. Without it the first update() does.
  void prepare();

  /// @param targets that acted in the step. @param pins likewise. @param vertices after it, #V by 3 [m].
  /// @param balancing unexplained forces that hold the body in that shape, without gravity, contacts and
  /// known loads, #V by 3 [N].
  /// @param elapsed_s since the last estimate. @param estimate the last one, then the new one.
  /// @return nothing in the first step after an edit: a blade edits in every frame, and modes take longer.
  std::optional<ShapePosterior> update(const std::vector<Target>& targets, const std::vector<Pin>& pins,
                                       const Points& vertices, const Points& balancing, double elapsed_s,
                                       LoadEstimate* estimate);

  /// Removes net force and torque from each piece, for loads from before a cut.
  void balance(const Points& vertices, Points* loads) const;

 private:
  using Motions = TurnedModes::Motions;
  struct Prior;
  struct Equations;

  Prior priorOf(const LoadEstimate& estimate, const Eigen::VectorXd& loads, double elapsed_s) const;
  Equations equationsAt(const Points& vertices, const Points& balancing, const Motions& motions,
                        double elapsed_s, const LoadEstimate& estimate);
  double looseness() const;
  double evidence(const Eigen::VectorXd& loads, const Eigen::MatrixXd& covariance) const;
  Eigen::MatrixXd curvature(const TargetEnergy& springs, const Points& vertices, const Motions& motions);
  void setSprings(const std::vector<Target>& targets, const std::vector<Pin>& pins);
  void balancePiece(const std::vector<int>& piece, const Points& vertices, Points* loads) const;

  const TetTopology& topology_;
  const TetMaterials& materials_;
  const Eigen::VectorXd masses_;
  const Options options_;
  const std::vector<std::vector<int>> pieces_;  ///< vertices of each piece
  std::vector<std::size_t> piece_of_vertex_;    ///< #V
  const double noise_;  ///< energy of a target of weight 1 at its standard deviation [J]

  /// What prepare() makes.
  DeformationModes modes_;
  Eigen::MatrixXd unknown_;            ///< covariance of loads of which nothing is known
  Eigen::MatrixXd unknown_precision_;  ///< its inverse
  std::unique_ptr<TurnedModes> turned_;
  std::unique_ptr<BlockTetMatrix> curvature_;  ///< of the springs

  std::vector<Target> measuring_, measuring_held_;  ///< targets of pieces without and with pins
  TargetEnergy springs_, springs_on_held_;          ///< of these
};

}  // namespace softbody
