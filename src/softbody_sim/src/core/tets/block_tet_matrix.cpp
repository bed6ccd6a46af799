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

BlockTetMatrix::BlockTetMatrix(const std::vector<Eigen::VectorXi>& groups, Eigen::Index vertex_count)
    : lower_(3 * vertex_count, 3 * vertex_count) {
  std::vector<Eigen::Triplet<double>> entries;
  for (int v = 0; v < vertex_count; ++v) addBlock(v, v, &entries);
  for (const Eigen::VectorXi& group : groups) {
    for (Eigen::Index a = 0; a < group.size(); ++a) {
      for (Eigen::Index b = 0; b < a; ++b)
        addBlock(std::max(group[a], group[b]), std::min(group[a], group[b]), &entries);
    }
  }
  lower_.setFromTriplets(entries.begin(), entries.end());
  lower_.makeCompressed();

  slots_.reserve(groups.size());
  for (const Eigen::VectorXi& group : groups) {
    std::vector<Slot>& slots = slots_.emplace_back();
    for (int a = 0; a < group.size(); ++a) {
      for (int b = 0; b <= a; ++b) {
        const bool in_order = group[a] >= group[b];
        const int row = in_order ? a : b, column = in_order ? b : a;
        slots.push_back(slotOf(group[row], group[column], row, column));
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

void BlockTetMatrix::addToGroup(std::size_t group, const Eigen::Ref<const Eigen::MatrixXd>& block) {
  for (const Slot& slot : slots_[group]) {
    for (int c = 0; c < 3; ++c) {
      const int first = slot.a == slot.b ? c : 0;
      double* values = lower_.valuePtr() + slot.columns[c];
      for (int r = first; r < 3; ++r) values[r - first] += block(3 * slot.a + r, 3 * slot.b + c);
    }
  }
}

}  // namespace softbody
