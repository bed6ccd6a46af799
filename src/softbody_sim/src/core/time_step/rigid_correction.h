#pragma once

#include <Eigen/Core>
#include <vector>

#include "simd/rows.h"
#include "softbody_common/geometry/types.h"
#include "time_step/incremental_potential.h"

namespace softbody {

/// Corrects a metric A for the rigid motions Z of each connected piece (deflation, Nicolaides 1987;
/// balancing, Mandel 1993): H0^-1 = P + (I - P H) A^-1 (I - H P) with P = Z (Z^T H Z)^-1 Z^T. A bounds the
/// stiffness of a contact in all directions, so with A alone a body hardly slides along its contacts.
/// Elasticity does not resist a rigid motion, so H Z is that of inertia and springs. Pieces that touch each
/// other are coupled.
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
    coefficients_ -= direct_;
    subtract(basis_, coefficients_, X);
  }

 private:
  using Matrix6 = Eigen::Matrix<double, 6, 6>;
  using Basis = Eigen::Matrix<double, 3, 6>;
  using Vector = Eigen::Matrix<T, Eigen::Dynamic, 1>;
  using Matrix = Eigen::Matrix<T, Eigen::Dynamic, Eigen::Dynamic>;
  using Block = Eigen::Matrix<T, 4, 6>;  ///< rows x, y, z, 0 of a vertex; columns: three turns, three shifts

  /// The part of H Z at a vertex by the motions of another piece.
  struct Coupling {
    std::size_t vertex, piece;
    Basis exact;
    Block block;
    int next;  ///< of the same vertex, or -1
  };
  /// Blocks of Z, or of H Z: one a vertex.
  struct Columns {
    std::vector<Block> blocks;
    std::vector<Coupling> couplings;
  };

  void setCenters(const Points& x);
  void addSpring(const TargetEnergy::Spring& spring, const Points& x);
  Basis motionsAt(const Eigen::Vector4i& vertices, const Eigen::Vector4d& barycentric) const;
  void addForces(const Eigen::Vector4i& vertices, const Eigen::Vector4d& barycentric, std::size_t piece,
                 const Basis& forces);
  void invert();
  /// (Z^T H Z)^-1 columns^T rows.
  void setCoefficients(const Columns& columns, const Rows<T>& rows);
  void subtract(const Columns& columns, const Vector& coefficients, Rows<T>* rows) const;

  struct Piece {
    Eigen::Vector3d center;
    double vertex_count;
    Matrix6 curvature;               ///< Z^T H Z
    Eigen::Matrix<T, 6, 6> inverse;  ///< of the curvature
  };

  std::vector<std::size_t> piece_of_vertex_;
  std::vector<Piece> pieces_;
  std::vector<Basis> exact_basis_, exact_stiffness_;  ///< Z and H Z: one block a vertex
  Columns basis_, stiffness_;                         ///< the same in the precision T
  std::vector<int> couplings_of_vertex_;              ///< first in the stiffness, or -1
  Eigen::MatrixXd curvature_;                         ///< Z^T H Z of all pieces, if some are coupled
  Matrix inverse_;                                    ///< of it
  Vector coefficients_, direct_, sums_;               ///< six a piece
  Rows<T> corrected_;
};

}  // namespace softbody
