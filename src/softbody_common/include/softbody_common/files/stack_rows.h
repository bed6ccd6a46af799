#pragma once

#include <Eigen/Core>
#include <vector>

namespace softbody {

/// Rows of a list as a matrix.
template <typename Matrix, typename Row>
Matrix stackRows(const std::vector<Row>& rows) {
  Matrix matrix(static_cast<Eigen::Index>(rows.size()), Matrix::ColsAtCompileTime);
  for (std::size_t r = 0; r < rows.size(); ++r) matrix.row(static_cast<Eigen::Index>(r)) = rows[r];
  return matrix;
}

}  // namespace softbody
