#pragma once

#include <vector>

#include "linear_solvers/positive_definite_solver.h"
#include "softbody_common/types.h"
#include "softbody_sim/constraints/surroundings.h"

namespace softbody {

/// Estimates the unknown external loads on an observed body. The springs of the targets carry the forces that
/// the known loads do not explain. The springs act only where the camera sees the body, but hands and
/// grippers act anywhere. So the spring forces are smoothed over the body, f <- M (M + l^2 L)^-1 f, with the
/// Laplacian L of the tets and the body's size l (a screened Poisson equation, which keeps the total force).
/// The results of all frames are added until the springs carry no force. This is the integral action of a
/// controller, and a gradient step towards the smallest forces that explain the observations. On each
/// connected piece the estimate has no net force or torque: only the springs move a piece rigidly, so an
/// occluded body stays in place.
///
/// A piece that a pin holds gets no new loads. There the springs also carry the force of the pin, and no load
/// removes the force with which a pin contradicts the camera: the sum would grow to many times the conflict.
class LoadEstimator {
 public:
  /// @param masses lumped, #V [kg]. @param fade_s time in which loads fall to 1/e; 0: loads are not
  /// estimated.
  LoadEstimator(const TetTopology& topology, const Eigen::VectorXd& masses, double fade_s);

  /// Allocates on the first call only. @param springs forces of the springs on the vertices, #V by 3 [N].
  /// @param pins of this step. @param vertices #V by 3 [m].
  /// @param loads previous estimate, then the new one, per mass, #V by 3 [m/s^2].
  void update(const Points& springs, const std::vector<Pin>& pins, const Points& vertices, double elapsed_s,
              Points* loads);

  /// Removes net force and torque from each piece, for loads from before a cut.
  void balance(const Points& vertices, Points* loads) const;

 private:
  void leaveOutHeldPieces(const std::vector<Pin>& pins);
  void balancePiece(const std::vector<int>& piece, const Points& vertices, Points* loads) const;

  Eigen::VectorXd masses_;
  std::vector<std::vector<int>> pieces_;      ///< vertices of each piece
  std::vector<std::size_t> piece_of_vertex_;  ///< #V
  double fade_s_;
  PositiveDefiniteSolver smoother_;
  Points unexplained_, spread_;
  std::vector<bool> held_;  ///< per piece: whether a pin holds it
};

}  // namespace softbody
