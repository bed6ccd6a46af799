#pragma once

#include <vector>

#include "linear_solvers/positive_definite_solver.h"
#include "softbody_common/types.h"

namespace softbody {

/// The forces from outside that an observed body is under. Nobody measures them, but the springs to what was
/// observed pull with what the known forces fail to explain. Springs act where the camera sees the body;
/// hands and grippers act anywhere. So the springs' forces are spread smoothly over the body's mass, f <- M
/// (M + l^2 L)^-1 f with the Laplacian L of the tets and a length l of the body's size (a screened Poisson
/// equation: totals stay), and added up from frame to frame until the springs are slack. It is the integral
/// action of a controller, and a gradient step towards the smallest forces that explain the observations. The
/// estimate balances on every connected piece: how it moves as a whole is left to the springs, so that a body
/// out of sight stays where it was.
class LoadEstimator {
 public:
  /// @param masses lumped, #V [kg]. @param fade_s in which remembered loads fall to 1/e; 0: none are
  /// estimated.
  LoadEstimator(const TetTopology& topology, const Eigen::VectorXd& masses, double fade_s);

  /// Allocates on the first call only. @param springs forces of the springs on the vertices, #V by 3 [N].
  /// @param vertices #V by 3 [m].
  /// @param loads as estimated so far, per mass, #V by 3 [m/s^2].
  void update(const Points& springs, const Points& vertices, double elapsed_s, Points* loads);

  /// Makes loads of before a cut balance on every piece.
  void balance(const Points& vertices, Points* loads) const;

 private:
  void balancePiece(const std::vector<int>& piece, const Points& vertices, Points* loads) const;

  Eigen::VectorXd masses_;
  std::vector<std::vector<int>> pieces_;  ///< vertices of each
  double fade_s_;
  PositiveDefiniteSolver smoother_;
  Points spread_;
};

}  // namespace softbody
