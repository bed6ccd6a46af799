#include "tets/tet_matrix.h"

#include <algorithm>

namespace softbody {
namespace {

int slotOf(const Eigen::SparseMatrix<double>& lower, int row, int column) {
  const int* first = lower.innerIndexPtr() + lower.outerIndexPtr()[column];
  const int* last = lower.innerIndexPtr() + lower.outerIndexPtr()[column + 1];
  return static_cast<int>(std::lower_bound(first, last, row) - lower.innerIndexPtr());
}

}  // namespace

TetMatrix::TetMatrix(const Tets& tets, Eigen::Index vertex_count) : lower_(vertex_count, vertex_count) {
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(static_cast<std::size_t>(vertex_count + 6 * tets.rows()));
  for (int v = 0; v < vertex_count; ++v) entries.emplace_back(v, v, 0.0);
  for (Eigen::Index t = 0; t < tets.rows(); ++t) {
    for (int a = 0; a < 4; ++a) {
      for (int b = 0; b < a; ++b) {
        entries.emplace_back(std::max(tets(t, a), tets(t, b)), std::min(tets(t, a), tets(t, b)), 0.0);
      }
    }
  }
  lower_.setFromTriplets(entries.begin(), entries.end());
  lower_.makeCompressed();

  for (int v = 0; v < vertex_count; ++v) diagonal_.push_back(slotOf(lower_, v, v));
  slots_.resize(static_cast<std::size_t>(tets.rows()));
  for (Eigen::Index t = 0; t < tets.rows(); ++t) {
    int k = 0;
    for (int a = 0; a < 4; ++a) {
      for (int b = 0; b <= a; ++b) {
        slots_[t][k++] = slotOf(lower_, std::max(tets(t, a), tets(t, b)), std::min(tets(t, a), tets(t, b)));
      }
    }
  }
}

void TetMatrix::addToDiagonal(const Eigen::VectorXd& diagonal) {
  for (std::size_t v = 0; v < diagonal_.size(); ++v) {
    lower_.valuePtr()[diagonal_[v]] += diagonal[static_cast<Eigen::Index>(v)];
  }
}

void TetMatrix::addToTet(int tet, const Eigen::Matrix4d& block) {
  const std::array<int, 10>& slots = slots_[static_cast<std::size_t>(tet)];
  int k = 0;
  for (int a = 0; a < 4; ++a) {
    for (int b = 0; b <= a; ++b) lower_.valuePtr()[slots[k++]] += block(a, b);
  }
}

}  // namespace softbody
