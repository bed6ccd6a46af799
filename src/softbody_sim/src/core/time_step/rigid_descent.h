#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <vector>

#include "softbody_common/geometry/types.h"
#include "time_step/incremental_potential.h"

namespace softbody {

/// Moves each connected piece of the tets rigidly towards the minimum of a step. Elasticity does not resist
/// such a motion. Pieces that touch each other are solved together. But in the metric of projective dynamics
/// a target with a normal resists in all directions, so its iteration moves a body only slowly along its own
/// surface.
class RigidDescent {
 public:
  explicit RigidDescent(const TetTopology& topology);

  /// One Gauss-Newton step of the six motions of each piece. Keeps x if the potential would not fall.
  /// @param x #V by 3 [m]. @param free a contact that is closed here counts as closed; so a body that only
  /// touches does not fall through. @return whether the potential fell.
  bool descend(const IncrementalPotential& potential, const Points& free, Points* x);

  /// Newton steps of the same motions for a potential with contacts, which open and close on the way. The
  /// potential may rise in between; x becomes the lowest point. @param free for the first step.
  void settle(const IncrementalPotential& potential, const Points& free, Points* x);

 private:
  using Matrix6d = Eigen::Matrix<double, 6, 6>;
  using Matrix63d = Eigen::Matrix<double, 6, 3>;
  using Vector6d = Eigen::Matrix<double, 6, 1>;

  /// The potential's change by a small turn about the centre and a shift: gradient and curvature.
  struct Motion {
    Eigen::Vector3d center;
    Vector6d gradient;
    Matrix6d curvature;

    /// Of the place of a point, by the six motions.
    Matrix63d slopes(const Eigen::Vector3d& point) const;
    void addGradient(const Eigen::Vector3d& point, const Eigen::Vector3d& force);
  };
  /// Mixed curvature of the motions of two pieces that touch each other.
  struct Coupling {
    std::size_t row_piece, column_piece;
    Matrix6d curvature;
  };

  void move(const IncrementalPotential& potential, const Points& free, Points* x);
  void addVertices(const IncrementalPotential& potential, const Points& x);
  void addSprings(const TargetEnergy& targets, const Points& free, const Points& x);
  void addCurvature(const TargetEnergy::Spring& spring, const Points& x, const Eigen::Matrix3d& curvature);
  void addGradient(const TargetEnergy::Spring& spring, const Points& x, const Eigen::Vector3d& force);
  Matrix6d& couplingOf(std::size_t row_piece, std::size_t column_piece);
  void findSteps();

  std::vector<std::vector<int>> pieces_;
  std::vector<std::size_t> piece_of_vertex_;
  std::vector<Motion> motions_;
  std::vector<Coupling> couplings_;
  Eigen::MatrixXd curvature_;  ///< of the motions of all pieces, if some touch each other
  Eigen::LDLT<Eigen::MatrixXd> factor_;
  Eigen::VectorXd steps_;  ///< of all motions
  Points gradient_, moved_, lowest_;
};

}  // namespace softbody
