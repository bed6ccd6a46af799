#pragma once

namespace softbody {

/// Whether two matrices of any sizes are equal; Eigen's == reads beyond the smaller one.
template <typename Matrix>
bool sameMatrix(const Matrix& a, const Matrix& b) {
  return a.rows() == b.rows() && a.cols() == b.cols() && a == b;
}

}  // namespace softbody
