#pragma once

#include <Eigen/Core>
#include <vector>

#include "simd/rows.h"
#include "softbody_common/types.h"
#include "time_step/incremental_potential.h"

namespace softbody {

/// Corrects a metric A for the rigid motions Z of each connected piece (deflation, Nicolaides 1987;
/// balancing, Mandel 1993): H0^-1 = P + (I - P H) A^-1 (I - H P) with P = Z (Z^T H Z)^-1 Z^T. A bounds the
/// stiffness of a contact in all directions, so with A alone a body hardly slides along its contacts.
/// Elasticity does not resist a rigid motion, so H Z is that of inertia and springs.
template <typename T>
class RigidCorrection {
 public:
  explicit RigidCorrection(const TetTopology& topology);

  /// @param x where the springs' curvatures are taken, #V by 3 [m].
  void linearize(const IncrementalPotential& potential, const Points& x);

  /// X = H0^-1 B. @param metric X = A^-1 B.
  template <typename Metric>
  void solve(const Metric& metric, const Rows<T>& B, Rows<T>* X) {
    setCoefficients(basis_, B);
    corrected_ = B;
    subtract(stiffness_, coefficients_, &corrected_);
    metric(corrected_, X);
    direct_ = coefficients_;
    setCoefficients(stiffness_, *X);
    for (std::size_t p = 0; p < direct_.size(); ++p) coefficients_[p] -= direct_[p];
    subtract(basis_, coefficients_, X);
  }

 private:
  using Matrix6 = Eigen::Matrix<double, 6, 6>;
  using Basis = Eigen::Matrix<double, 3, 6>;
  using Vector6 = Eigen::Matrix<T, 6, 1>;
  using Block = Eigen::Matrix<T, 4, 6>;  ///< rows x, y, z, 0 of a vertex; columns: three turns, three shifts

  void setCenters(const Points& x);
  void addSpring(const TargetEnergy::Spring& spring, const Points& x);
  /// (Z^T H Z)^-1 blocks^T rows for each piece.
  void setCoefficients(const std::vector<Block>& blocks, const Rows<T>& rows);
  void subtract(const std::vector<Block>& blocks, const std::vector<Vector6>& coefficients,
                Rows<T>* rows) const;

  struct Piece {
    Eigen::Vector3d center;
    double vertex_count;
    Matrix6 curvature;               ///< Z^T H Z
    Eigen::Matrix<T, 6, 6> inverse;  ///< of the curvature
  };

  std::vector<std::size_t> piece_of_vertex_;
  std::vector<Piece> pieces_;
  std::vector<Basis> exact_basis_, exact_stiffness_;  ///< Z and H Z: one block a vertex
  std::vector<Block> basis_, stiffness_;              ///< the same in the precision T
  std::vector<Vector6> coefficients_, direct_;
  Rows<T> corrected_;
};

}  // namespace softbody
