#include "linear_solvers/dissection.h"

namespace softbody {
namespace {

using Levels = std::vector<std::vector<int>>;
using Neighbors = std::vector<std::vector<int>>;

Neighbors neighborsOf(const Eigen::SparseMatrix<double>& lower) {
  Neighbors neighbors(static_cast<std::size_t>(lower.rows()));
  for (int column = 0; column < lower.cols(); ++column) {
    for (Eigen::SparseMatrix<double>::InnerIterator entry(lower, column); entry; ++entry) {
      const int row = static_cast<int>(entry.row());
      if (row == column) continue;
      neighbors[static_cast<std::size_t>(row)].push_back(column);
      neighbors[static_cast<std::size_t>(column)].push_back(row);
    }
  }
  return neighbors;
}

/// Levels of the breadth-first search from `start`. An empty level follows each connected component.
Levels levelsFrom(int start, const Neighbors& neighbors) {
  const int count = static_cast<int>(neighbors.size());
  std::vector<bool> seen(neighbors.size());
  Levels levels;
  for (int k = 0; k < count; ++k) {
    const int root = (start + k) % count;
    if (seen[static_cast<std::size_t>(root)]) continue;
    seen[static_cast<std::size_t>(root)] = true;
    levels.push_back({root});
    while (!levels.back().empty()) {
      std::vector<int> next;
      for (int v : levels.back()) {
        for (int w : neighbors[static_cast<std::size_t>(v)]) {
          if (seen[static_cast<std::size_t>(w)]) continue;
          seen[static_cast<std::size_t>(w)] = true;
          next.push_back(w);
        }
      }
      levels.push_back(std::move(next));
    }
  }
  return levels;
}

/// Size of the three dense blocks of SplitInverse.
double blockSizes(double first, double separator, double second) {
  return separator * (first + separator + second) + first * (first + separator) +
         second * (second + separator);
}

}  // namespace

Dissection dissect(const Eigen::SparseMatrix<double>& lower) {
  const Neighbors neighbors = neighborsOf(lower);
  const int count = static_cast<int>(neighbors.size());
  Dissection best;
  if (count == 0) return best;
  // The last level before the empty one holds the farthest vertices.
  const Levels rough = levelsFrom(0, neighbors);
  const Levels levels = levelsFrom(rough[rough.size() - 2].back(), neighbors);
  best.first = count;
  int before = 0;
  for (const std::vector<int>& level : levels) {
    const int size = static_cast<int>(level.size()), after = count - before - size;
    if (blockSizes(before, size, after) < blockSizes(best.first, best.separator, best.second)) {
      best.first = before;
      best.separator = size;
      best.second = after;
    }
    before += size;
    best.order.insert(best.order.end(), level.begin(), level.end());
  }
  return best;
}

}  // namespace softbody
