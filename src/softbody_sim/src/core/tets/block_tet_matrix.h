#pragma once

#include <Eigen/SparseCore>
#include <array>
#include <vector>

#include "softbody_common/geometry/types.h"

namespace softbody {

/// A symmetric 3 #V by 3 #V matrix that couples the coordinates of groups of vertices, for example of each
/// tet. (x, y, z) of vertex v are in rows 3 v to 3 v + 2. The pattern is fixed; adding never allocates.
class BlockTetMatrix {
 public:
  BlockTetMatrix(const std::vector<Eigen::VectorXi>& groups, Eigen::Index vertex_count);

  void setZero();
  /// Adds a value per vertex to the diagonal entries of its three coordinates. @param diagonal #V.
  void addToDiagonal(const Eigen::VectorXd& diagonal);
  /// Adds a symmetric block over the coordinates of a group's vertices.
  void addToGroup(std::size_t group, const Eigen::Ref<const Eigen::MatrixXd>& block);

  /// Lower triangle, compressed.
  const Eigen::SparseMatrix<double>& lower() const { return lower_; }

 private:
  /// Where the columns of the block of vertices (row, column) start in the value array. Only the lower
  /// triangle of a diagonal block is stored.
  struct Slot {
    int a, b;  ///< places in the group of the row and of the column
    std::array<int, 3> columns;
  };
  Slot slotOf(int row_vertex, int column_vertex, int a, int b) const;

  Eigen::SparseMatrix<double> lower_;
  std::vector<std::vector<Slot>> slots_;  ///< per group
};

}  // namespace softbody
