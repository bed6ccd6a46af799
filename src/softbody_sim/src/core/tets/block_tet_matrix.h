#pragma once

#include <Eigen/SparseCore>
#include <array>
#include <vector>

#include "softbody_common/types.h"

namespace softbody {

/// A symmetric 3 #V by 3 #V matrix that couples the coordinates of each tet's vertices, (x, y, z) of vertex v
/// in rows 3 v to 3 v + 2. The pattern is fixed; adding never allocates.
class BlockTetMatrix {
 public:
  using TetBlock = Eigen::Matrix<double, 12, 12>;

  BlockTetMatrix(const Tets& tets, Eigen::Index vertex_count);

  void setZero();
  /// Adds a value per vertex to the diagonal entries of its three coordinates. @param diagonal #V.
  void addToDiagonal(const Eigen::VectorXd& diagonal);
  /// Adds a symmetric block over the coordinates of the tet's four vertices.
  void addToTet(int tet, const TetBlock& block);

  /// Lower triangle, compressed.
  const Eigen::SparseMatrix<double>& lower() const { return lower_; }

 private:
  /// Where the columns of the block of vertices (row, column) start in the value array. Only the lower
  /// triangle of a diagonal block is stored.
  struct Slot {
    int a, b;  ///< corners of the row and of the column
    std::array<int, 3> columns;
  };
  Slot slotOf(int row_vertex, int column_vertex, int a, int b) const;

  Eigen::SparseMatrix<double> lower_;
  std::vector<std::array<Slot, 10>> slots_;  ///< per tet
};

}  // namespace softbody
