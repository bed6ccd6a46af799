#pragma once

#include <Eigen/SparseCore>
#include <vector>

namespace softbody {

/// Partition of a symmetric matrix's rows into two parts and a separator. No entry couples the two parts.
struct Dissection {
  std::vector<int> order;                    ///< rows of the first part, the separator, the second part
  int first = 0, separator = 0, second = 0;  ///< number of rows
};

/// Separates by a level of a breadth-first search from a peripheral vertex (George and Liu 1981). It takes
/// the level with the cheapest products with the inverses of both parts. @param lower compressed lower
/// triangle, for its pattern.
Dissection dissect(const Eigen::SparseMatrix<double>& lower);

}  // namespace softbody
