#pragma once

#include <Eigen/SparseCore>
#include <vector>

namespace softbody {

/// Rows of a symmetric matrix in two parts and a separator: no entry couples one part with the other.
struct Dissection {
  std::vector<int> order;                    ///< the first part's rows, the separator's, the second part's
  int first = 0, separator = 0, second = 0;  ///< how many of each
};

/// The level of a breadth-first search from the graph's far end (George and Liu 1981) that makes products
/// with the inverses of both parts cheapest. @param lower compressed lower triangle, for its pattern.
Dissection dissect(const Eigen::SparseMatrix<double>& lower);

}  // namespace softbody
