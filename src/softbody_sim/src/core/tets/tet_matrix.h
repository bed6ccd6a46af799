#pragma once

#include <Eigen/SparseCore>
#include <array>
#include <vector>

#include "softbody_common/geometry/types.h"

namespace softbody {

/// A #V vector whose only non-zero entries are at a tet's four vertices. They differ where values are not 0.
struct TetVector {
  Eigen::Vector4i vertices;
  Eigen::Vector4d values;
};

/// A symmetric #V by #V matrix that couples the vertices of each tet. The pattern is fixed; adding never
/// allocates.
class TetMatrix {
 public:
  TetMatrix(const Tets& tets, Eigen::Index vertex_count);

  void addToDiagonal(const Eigen::VectorXd& diagonal);
  /// Adds a symmetric block over the tet's four vertices.
  void addToTet(int tet, const Eigen::Matrix4d& block);

  /// Lower triangle, compressed.
  const Eigen::SparseMatrix<double>& lower() const { return lower_; }
  /// Values of the lower triangle, in its order.
  Eigen::Map<Eigen::VectorXd> values() { return {lower_.valuePtr(), lower_.nonZeros()}; }

 private:
  Eigen::SparseMatrix<double> lower_;
  std::vector<std::array<int, 10>> slots_;  ///< per tet: where the entries (a, b <= a) are in the values
  std::vector<int> diagonal_;               ///< per vertex
};

}  // namespace softbody
