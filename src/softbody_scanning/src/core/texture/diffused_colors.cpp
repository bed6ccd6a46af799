#include "texture/diffused_colors.h"

#include <Eigen/SparseCholesky>
#include <algorithm>

namespace softbody::scanning {
namespace {

// A pull to the mean that only shows where nothing else is known.
constexpr double kPull = 1e-6;

Eigen::RowVector3d meanColor(const std::vector<bool>& known, const Points& colors) {
  Eigen::RowVector3d sum = Eigen::RowVector3d::Zero();
  double count = 0.0;
  for (std::size_t v = 0; v < known.size(); ++v) {
    if (!known[v]) continue;
    sum += colors.row(static_cast<Eigen::Index>(v));
    count += 1.0;
  }
  return sum / std::max(1.0, count);
}

}  // namespace

void diffuseColors(const Triangles& triangles, const std::vector<bool>& known, Points* colors) {
  std::vector<int> number(known.size(), -1);
  int count = 0;
  for (std::size_t v = 0; v < known.size(); ++v) {
    if (!known[v]) number[v] = count++;
  }
  if (count == 0) return;
  const Eigen::RowVector3d mean = meanColor(known, *colors);
  std::vector<Eigen::Triplet<double>> entries;
  Eigen::MatrixXd right_side(count, 3);
  for (int i = 0; i < count; ++i) {
    right_side.row(i) = kPull * mean;
    entries.emplace_back(i, i, kPull);
  }
  for (const auto& triangle : triangles.rowwise()) {
    for (int k = 0; k < 6; ++k) {  // each side in both directions
      const int v = triangle[k % 3], other = triangle[(k % 3 + (k < 3 ? 1 : 2)) % 3];
      const int i = number[static_cast<std::size_t>(v)], j = number[static_cast<std::size_t>(other)];
      if (i < 0) continue;
      entries.emplace_back(i, i, 1.0);
      if (j < 0)
        right_side.row(i) += colors->row(other);
      else if (j < i)
        entries.emplace_back(i, j, -1.0);
    }
  }
  Eigen::SparseMatrix<double> matrix(count, count);
  matrix.setFromTriplets(entries.begin(), entries.end());
  const Eigen::MatrixXd solution =
      Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>>(matrix).solve(right_side);
  for (std::size_t v = 0; v < known.size(); ++v) {
    if (number[v] >= 0) colors->row(static_cast<Eigen::Index>(v)) = solution.row(number[v]);
  }
}

}  // namespace softbody::scanning
