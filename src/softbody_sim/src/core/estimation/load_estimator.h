#pragma once

#include <Eigen/Core>
#include <array>
#include <memory>
#include <optional>
#include <vector>

#include "constraints/target_energy.h"
#include "elasticity/tet_materials.h"
#include "estimation/load_estimate.h"
#include "estimation/turned_modes.h"
#include "linear_solvers/dense_kernels.h"
#include "softbody_common/geometry/types.h"
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
    double fade_s = 0.0;            ///< time in which what is known of loads falls to 1/e; above 0
    double target_stiffness = 0.0;  ///< of a target of weight 1 [N/m]
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
  struct Equations;
  using Rotations = std::vector<Eigen::Matrix3d>;  ///< of each vertex

  void setSprings(const std::vector<Target>& targets, const std::vector<Pin>& pins);
  void setRigidMotions(std::size_t piece, const Points& vertices, const Rotations& rotations);
  void setCurvature(const TargetEnergy& springs, const Points& vertices);
  Eigen::MatrixXd curvature(std::size_t piece, const Rotations& rotations) const;
  Eigen::MatrixX3d along(std::size_t piece, const Rotations& rotations,
                         const std::array<const Points*, 3>& forces) const;
  Equations equationsOf(std::size_t piece, const Rotations& rotations,
                        const std::array<const Points*, 3>& forces, const LoadEstimate& last,
                        double elapsed_s) const;
  Eigen::VectorXd estimatePiece(std::size_t piece, const Rotations& rotations, const Equations& equations,
                                LoadEstimate* estimate) const;
  double looseness() const;
  double evidence(const std::vector<Eigen::VectorXd>& loads, const LoadEstimate& estimate) const;
  void balancePiece(const std::vector<int>& piece, const Points& vertices, Points* loads) const;

  const TetTopology& topology_;
  const TetMaterials& materials_;
  const Eigen::VectorXd masses_;
  const Options options_;
  const std::vector<std::vector<int>> pieces_;  ///< vertices of each piece
  std::vector<std::size_t> piece_of_vertex_;    ///< #V
  std::vector<int> place_in_piece_;             ///< #V
  const double noise_;  ///< energy of a target of weight 1 at its standard deviation [J]

  /// What prepare() makes; per piece, along its modes.
  std::vector<Eigen::VectorXd> stiffness_;  ///< see DeformationModes
  /// x y z of each vertex by paddedColumns(rigid motions and modes), in the axes of the vertex.
  std::vector<DenseRows<double>> motions_;
  std::vector<DenseRows<float>> float_motions_;     ///< without the padding
  std::vector<Eigen::MatrixXd> unknown_;            ///< covariance of loads of which nothing is known
  std::vector<Eigen::MatrixXd> unknown_precision_;  ///< its inverse
  std::unique_ptr<TurnedModes> turned_;

  std::unique_ptr<BlockTetMatrix> curvature_;  ///< of springs
  std::vector<std::vector<int>> measured_;     ///< vertices that they act on, of each piece
  std::vector<int> measured_place_;            ///< #V: place in these; -1: none

  std::vector<Target> measuring_, measuring_held_;  ///< targets of pieces without and with pins
  TargetEnergy springs_, springs_on_held_;          ///< of these
};

}  // namespace softbody
