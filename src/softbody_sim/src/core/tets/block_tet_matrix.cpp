#include "tets/block_tet_matrix.h"

#include <algorithm>

namespace softbody {
namespace {

void addBlock(int row_vertex, int column_vertex, std::vector<Eigen::Triplet<double>>* entries) {
  for (int c = 0; c < 3; ++c) {
    for (int r = row_vertex == column_vertex ? c : 0; r < 3; ++r)
      entries->emplace_back(3 * row_vertex + r, 3 * column_vertex + c, 0.0);
  }
}

}  // namespace

BlockTetMatrix::BlockTetMatrix(const Tets& tets, Eigen::Index vertex_count)
    : lower_(3 * vertex_count, 3 * vertex_count) {
  std::vector<Eigen::Triplet<double>> entries;
  for (int v = 0; v < vertex_count; ++v) addBlock(v, v, &entries);
  for (Eigen::Index t = 0; t < tets.rows(); ++t) {
    for (int a = 0; a < 4; ++a) {
      for (int b = 0; b < a; ++b)
        addBlock(std::max(tets(t, a), tets(t, b)), std::min(tets(t, a), tets(t, b)), &entries);
    }
  }
  lower_.setFromTriplets(entries.begin(), entries.end());
  lower_.makeCompressed();

  slots_.resize(static_cast<std::size_t>(tets.rows()));
  for (Eigen::Index t = 0; t < tets.rows(); ++t) {
    int k = 0;
    for (int a = 0; a < 4; ++a) {
      for (int b = 0; b <= a; ++b) {
        const bool in_order = tets(t, a) >= tets(t, b);
        const int row = in_order ? a : b, column = in_order ? b : a;
        slots_[t][k++] = slotOf(tets(t, row), tets(t, column), row, column);
      }
    }
  }
}

BlockTetMatrix::Slot BlockTetMatrix::slotOf(int row_vertex, int column_vertex, int a, int b) const {
  Slot slot{a, b, {}};
  for (int c = 0; c < 3; ++c) {
    const int column = 3 * column_vertex + c;
    const int row = 3 * row_vertex + (row_vertex == column_vertex ? c : 0);
    const int* first = lower_.innerIndexPtr() + lower_.outerIndexPtr()[column];
    const int* last = lower_.innerIndexPtr() + lower_.outerIndexPtr()[column + 1];
    slot.columns[c] = static_cast<int>(std::lower_bound(first, last, row) - lower_.innerIndexPtr());
  }
  return slot;
}

void BlockTetMatrix::setZero() { lower_.coeffs().setZero(); }

void BlockTetMatrix::addToDiagonal(const Eigen::VectorXd& diagonal) {
  for (Eigen::Index i = 0; i < lower_.rows(); ++i)
    lower_.valuePtr()[lower_.outerIndexPtr()[i]] += diagonal[i / 3];  // a column starts with its diagonal
}

void BlockTetMatrix::addToTet(int tet, const TetBlock& block) {
  for (const Slot& slot : slots_[static_cast<std::size_t>(tet)]) {
    for (int c = 0; c < 3; ++c) {
      const int first = slot.a == slot.b ? c : 0;
      double* values = lower_.valuePtr() + slot.columns[c];
      for (int r = first; r < 3; ++r) values[r - first] += block(3 * slot.a + r, 3 * slot.b + c);
    }
  }
}

}  // namespace softbody
