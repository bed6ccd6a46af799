#include "linear_solvers/global_step_solver.h"

#include <algorithm>
#include <cmath>
#include <type_traits>

namespace softbody {
namespace {

/// Numbers of PanelSolve's scratch memory for each of PanelFactor::largest().
constexpr Eigen::Index kScratch = 28;

/// Half precision needs instructions of AVX2.
template <typename T>
bool readsHalves(Simd simd) {
  return std::is_same_v<T, float> && supportedSimd(simd) != Simd::kSse4;
}

}  // namespace

template <typename T>
GlobalStepSolver<T>::GlobalStepSolver(const Eigen::SparseMatrix<double>& lower, Simd simd)
    : factorization_(lower),
      solve_panels_(panelSolve<T>(simd)),
      count_(static_cast<int>(lower.rows())),
      reads_halves_(readsHalves<T>(simd) && count_ > kLargestInverse),
      scale_(count_),
      permuted_(Rows<T>::Zero(paddedRows(count_), 4)) {
  factorization_.reserveUpdates(kMaxUpdates);
  if (count_ <= kLargestInverse) inverse_.emplace(lower, simd);
}

template <typename T>
void GlobalStepSolver<T>::factorize(const Eigen::SparseMatrix<double>& lower) {
  factorization_.factorize(lower);
  sums_.setZero(count_);
  for (int column = 0; column < count_; ++column) {
    for (Eigen::SparseMatrix<double>::InnerIterator entry(lower, column); entry; ++entry) {
      sums_[entry.row()] += entry.value();
      if (entry.row() != column) sums_[column] += entry.value();
    }
  }
  for (int k = 0; k < count_; ++k) {
    const int first = lower.outerIndexPtr()[factorization_.order()[static_cast<std::size_t>(k)]];
    scale_[k] = static_cast<T>(1.0 / std::sqrt(lower.valuePtr()[first]));  // the diagonal comes first
  }
  readFactor();
}

template <typename T>
void GlobalStepSolver<T>::update(const std::vector<TetVector>& added, const std::vector<TetVector>& removed) {
  factorization_.update(added, removed);
  addToSums(added, 1.0);
  addToSums(removed, -1.0);
  readFactor();
}

template <typename T>
void GlobalStepSolver<T>::addToSums(const std::vector<TetVector>& vectors, double sign) {
  for (const TetVector& v : vectors) {
    for (int k = 0; k < 4; ++k) sums_[v.vertices[k]] += sign * v.values.sum() * v.values[k];
  }
}

template <typename T>
void GlobalStepSolver<T>::readFactor() {
  solves_ = 0;
  inverted_ = false;
  factor_.set(factorization_, scale_, reads_halves_);
  scratch_.resize(kScratch * factor_.largest());
  if (reads_halves_ && !isAccurate()) factor_.set(factorization_, scale_, false);
}

/// Whether an iteration of projective dynamics with this factor lowers the energy also along the softest
/// motions, where it errs most: there A must not be more than 1.5 times the factored matrix. The softest
/// motion of each piece is close to a translation x = 1, for which A x is known.
template <typename T>
bool GlobalStepSolver<T>::isAccurate() {
  const std::vector<int>& order = factorization_.order();
  for (int k = 0; k < count_; ++k)
    permuted_.row(k).setConstant(scale_[k] * static_cast<T>(sums_[order[static_cast<std::size_t>(k)]]));
  permuted_.col(3).setZero();
  solve_panels_(factor_, scratch_.data(), permuted_.data());
  for (int k = 0; k < count_; ++k)
    if (!(std::abs(static_cast<double>(scale_[k] * permuted_(k, 0)) - 1.0) < 0.5)) return false;  // or NaN
  return true;
}

template <typename T>
void GlobalStepSolver<T>::solve(const Rows<T>& B, Rows<T>* X) {
  // An inversion costs about count_ / 4 sparse solves and makes a solve two to three times faster.
  if (!inverted_ && inverse_ && ++solves_ > count_ / 2) invert();
  if (inverted_)
    inverse_->multiply(B, X);
  else
    solveSparse(B, X);
}

template <typename T>
template <typename Number>
void GlobalStepSolver<T>::solveSparse(const Rows<Number>& B, Rows<Number>* X) {
  const int* order = factorization_.order().data();
  for (int k = 0; k < count_; ++k) permuted_.row(k) = scale_[k] * B.row(order[k]).template cast<T>();
  solve_panels_(factor_, scratch_.data(), permuted_.data());
  for (int k = 0; k < count_; ++k) X->row(order[k]) = (scale_[k] * permuted_.row(k)).template cast<Number>();
}

/// Three columns at once: the numbers of a row are three right-hand sides.
template <typename T>
void GlobalStepSolver<T>::invert() {
  const std::vector<int>& order = factorization_.order();
  for (int first = 0; first < count_; first += 3) {
    const int columns = std::min(3, count_ - first);
    permuted_.setZero();
    for (int c = 0; c < columns; ++c) permuted_(first + c, c) = scale_[first + c];
    solve_panels_(factor_, scratch_.data(), permuted_.data());
    for (int c = 0; c < columns; ++c) {
      auto column = inverse_->inverse().col(inverse_->placeOf(order[first + c]));
      for (int v = 0; v < count_; ++v) column[inverse_->placeOf(order[v])] = scale_[v] * permuted_(v, c);
    }
  }
  inverted_ = inverse_->split();
  if (!inverted_) inverse_.reset();  // too stiff for T: use the factor in double
}

template class GlobalStepSolver<float>;
template class GlobalStepSolver<double>;
template void GlobalStepSolver<float>::solveSparse(const Rows<double>&, Rows<double>*);

}  // namespace softbody
