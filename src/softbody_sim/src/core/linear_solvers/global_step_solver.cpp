#include "linear_solvers/global_step_solver.h"

#include <algorithm>
#include <cmath>

namespace softbody {
namespace {

/// For larger matrices a dense product takes longer than two sparse triangular solves.
constexpr int kLargestInverse = 500;

/// Whether column j + 1 has the rows of column j except j: then both belong to one supernode.
bool sameRows(const CholeskyView& L, int j) {
  return j + 1 < L.count && L.row_counts[j] == L.row_counts[j + 1] + 1 && L.rows[L.starts[j] + 1] == j + 1;
}

int panelWidth(const CholeskyView& L, int first) {
  int width = 1;
  while (width < 4 && sameRows(L, first + width - 1)) ++width;
  return width == 3 ? 2 : width;
}

template <typename T>
void appendPanel(const CholeskyView& L, int first, int width, PanelFactor<T>* factor) {
  typename PanelFactor<T>::Panel panel{};
  panel.first_column = first;
  panel.width = width;
  panel.row_begin = static_cast<int>(factor->rows.size());
  panel.value_begin = static_cast<int>(factor->values.size());
  double scale[4];  // turns a column of L into one of L sqrt(D)
  for (int c = 0; c < width; ++c) {
    const double* column = L.values + L.starts[first + c];
    scale[c] = std::sqrt(column[0]);
    panel.triangle[c][c] = static_cast<T>(1.0 / scale[c]);
    for (int r = c + 1; r < width; ++r) panel.triangle[r][c] = static_cast<T>(scale[c] * column[r - c]);
  }
  const int last = first + width - 1;
  for (int k = 1; k < L.row_counts[last]; ++k) {
    factor->rows.push_back(L.rows[L.starts[last] + k]);
    for (int c = 0; c < width; ++c) {
      factor->values.push_back(static_cast<T>(scale[c] * L.values[L.starts[first + c] + k + width - 1 - c]));
    }
  }
  panel.row_end = static_cast<int>(factor->rows.size());
  factor->panels.push_back(panel);
}

}  // namespace

template <typename T>
GlobalStepSolver<T>::GlobalStepSolver(const Eigen::SparseMatrix<double>& lower, Simd simd)
    : factorization_(lower),
      solve_panels_(panelSolve<T>(simd)),
      count_(static_cast<int>(lower.rows())),
      permuted_(Rows<T>::Zero(paddedRows(count_), 4)) {
  factorization_.reserveUpdates(kMaxUpdates);
  if (count_ <= kLargestInverse) inverse_.emplace(lower, simd);
}

template <typename T>
void GlobalStepSolver<T>::factorize(const Eigen::SparseMatrix<double>& lower) {
  factorization_.factorize(lower);
  packFactor();
}

template <typename T>
void GlobalStepSolver<T>::update(const std::vector<TetVector>& added, const std::vector<TetVector>& removed) {
  factorization_.update(added, removed);
  packFactor();
}

template <typename T>
void GlobalStepSolver<T>::packFactor() {
  const CholeskyView L = factorization_.factor();
  factor_.panels.clear();
  factor_.rows.clear();
  factor_.values.clear();
  for (int first = 0; first < L.count; first += factor_.panels.back().width) {
    appendPanel(L, first, panelWidth(L, first), &factor_);
  }
  solves_ = 0;
  inverted_ = false;
}

template <typename T>
void GlobalStepSolver<T>::solve(const Rows<T>& B, Rows<T>* X) {
  // An inversion costs about count_ / 4 sparse solves and makes a solve two to three times faster.
  if (!inverted_ && inverse_ && ++solves_ > count_ / 2) invert();
  if (inverted_) {
    inverse_->multiply(B, X);
    return;
  }
  const int* order = factorization_.factor().order;
  const auto count = static_cast<std::size_t>(count_);
  gatherRows(B.data(), order, count, permuted_.data());
  solve_panels_(factor_, permuted_.data());
  scatterRows(permuted_.data(), order, count, X->data());
}

/// Four columns at once: the four numbers of a row are four right-hand sides.
template <typename T>
void GlobalStepSolver<T>::invert() {
  const int* order = factorization_.factor().order;
  for (int first = 0; first < count_; first += 4) {
    const int columns = std::min(4, count_ - first);
    permuted_.setZero();
    for (int c = 0; c < columns; ++c) permuted_(first + c, c) = T{1};
    solve_panels_(factor_, permuted_.data());
    for (int c = 0; c < columns; ++c) {
      auto column = inverse_->inverse().col(inverse_->placeOf(order[first + c]));
      for (int v = 0; v < count_; ++v) column[inverse_->placeOf(order[v])] = permuted_(v, c);
    }
  }
  inverted_ = inverse_->split();
  if (!inverted_) inverse_.reset();  // too stiff for T: use the factor in double
}

template class GlobalStepSolver<float>;
template class GlobalStepSolver<double>;

}  // namespace softbody
