#include "linear_solvers/positive_definite_solver.h"

#include <cholmod.h>

#include <algorithm>
#include <array>
#include <stdexcept>
#include <utility>

namespace softbody {
namespace {

/// Three right-hand sides, padded by zeros to whole vectors.
using SubstitutedRows = Eigen::Matrix<double, Eigen::Dynamic, 4, Eigen::RowMajor>;

/// CHOLMOD's view of a compressed triangle. CHOLMOD does not write to the memory.
/// @param triangle -1: lower, 1: upper.
cholmod_sparse view(const Eigen::SparseMatrix<double>& matrix, int triangle) {
  cholmod_sparse A{};
  A.nrow = static_cast<std::size_t>(matrix.rows());
  A.ncol = static_cast<std::size_t>(matrix.cols());
  A.nzmax = static_cast<std::size_t>(matrix.nonZeros());
  A.p = const_cast<int*>(matrix.outerIndexPtr());
  A.i = const_cast<int*>(matrix.innerIndexPtr());
  A.x = const_cast<double*>(matrix.valuePtr());
  A.stype = triangle;
  A.itype = CHOLMOD_INT;
  A.xtype = CHOLMOD_REAL;
  A.dtype = CHOLMOD_DOUBLE;
  A.sorted = 1;
  A.packed = 1;
  return A;
}

}  // namespace

struct PositiveDefiniteSolver::Implementation {
  cholmod_common common;
  cholmod_factor* factor = nullptr;
  /// A in the factor's order. CHOLMOD would copy a matrix that it has to permute or transpose.
  Eigen::SparseMatrix<double> upper;
  std::vector<int> slots;         ///< positions of the values of A's lower triangle in `upper`
  std::vector<int> order, place;  ///< vertex at each position of the factor's order, and its inverse
  std::vector<int> starts, rows;
  std::vector<double> values;  ///< of an update's columns
  SubstitutedRows substituted;

  Implementation() {
    cholmod_start(&common);
    common.print = 0;
    common.supernodal = CHOLMOD_SIMPLICIAL;
    common.final_ll = 0;  // only L D L' can be updated
    common.final_pack = 1;
    common.final_monotonic = 1;
  }
  ~Implementation() {
    cholmod_free_factor(&factor, &common);
    cholmod_finish(&common);
  }
  /// L D L' accepts an indefinite matrix.
  void requirePositive() const {
    const auto* starts_of_L = static_cast<const int*>(factor->p);
    const auto* values_of_L = static_cast<const double*>(factor->x);
    for (std::size_t j = 0; common.status == CHOLMOD_OK && j < factor->n; ++j) {
      if (values_of_L[starts_of_L[j]] > 0.0) continue;
      throw std::runtime_error("the system matrix is not positive definite");
    }
    if (common.status != CHOLMOD_OK) throw std::runtime_error("the system matrix is not positive definite");
  }
  void findOrder(const Eigen::SparseMatrix<double>& lower);
  void permute(const Eigen::SparseMatrix<double>& lower);
  void update(const std::vector<TetVector>& columns, bool add);

  Implementation(const Implementation&) = delete;
  Implementation& operator=(const Implementation&) = delete;
};

void PositiveDefiniteSolver::Implementation::update(const std::vector<TetVector>& columns, bool add) {
  if (columns.empty()) return;
  starts.assign(1, 0);
  rows.clear();
  values.clear();
  for (const TetVector& column : columns) {
    std::array<std::pair<int, double>, 4> entries;
    for (int k = 0; k < 4; ++k)
      entries[k] = {place[static_cast<std::size_t>(column.vertices[k])], column.values[k]};
    std::sort(entries.begin(), entries.end());
    for (const auto& [row, value] : entries) {
      rows.push_back(row);
      values.push_back(value);
    }
    starts.push_back(static_cast<int>(rows.size()));
  }
  cholmod_sparse C{};
  C.nrow = factor->n;
  C.ncol = columns.size();
  C.nzmax = rows.size();
  C.p = starts.data();
  C.i = rows.data();
  C.x = values.data();
  C.itype = CHOLMOD_INT;
  C.xtype = CHOLMOD_REAL;
  C.dtype = CHOLMOD_DOUBLE;
  C.sorted = 1;
  C.packed = 1;
  cholmod_updown(add ? 1 : 0, &C, factor, &common);
}

void PositiveDefiniteSolver::Implementation::findOrder(const Eigen::SparseMatrix<double>& lower) {
  cholmod_sparse A = view(lower, -1);
  cholmod_factor* analysis = cholmod_analyze(&A, &common);
  if (analysis == nullptr) throw std::runtime_error("CHOLMOD could not analyse the matrix");
  const auto* permutation = static_cast<const int*>(analysis->Perm);
  order.assign(permutation, permutation + A.nrow);
  cholmod_free_factor(&analysis, &common);
  place.resize(A.nrow);
  for (std::size_t k = 0; k < A.nrow; ++k) place[static_cast<std::size_t>(order[k])] = static_cast<int>(k);
}

/// Sets the pattern of `upper`, and `slots`.
void PositiveDefiniteSolver::Implementation::permute(const Eigen::SparseMatrix<double>& lower) {
  std::vector<Eigen::Triplet<double>> entries;
  for (int column = 0; column < lower.cols(); ++column) {
    for (Eigen::SparseMatrix<double>::InnerIterator entry(lower, column); entry; ++entry) {
      const auto [first, last] =
          std::minmax(place[static_cast<std::size_t>(entry.row())], place[static_cast<std::size_t>(column)]);
      entries.emplace_back(first, last, static_cast<double>(entries.size()));
    }
  }
  upper.resize(lower.rows(), lower.cols());
  upper.setFromTriplets(entries.begin(), entries.end());
  slots.resize(entries.size());
  for (Eigen::Index k = 0; k < upper.nonZeros(); ++k)
    slots[static_cast<std::size_t>(upper.valuePtr()[k])] = static_cast<int>(k);
}

PositiveDefiniteSolver::PositiveDefiniteSolver(const Eigen::SparseMatrix<double>& lower)
    : implementation_(std::make_unique<Implementation>()) {
  Implementation& s = *implementation_;
  s.findOrder(lower);
  s.permute(lower);
  s.common.nmethods = 1;
  s.common.method[0].ordering = CHOLMOD_NATURAL;
  s.common.postorder = 0;
  cholmod_sparse A = view(s.upper, 1);
  s.factor = cholmod_analyze(&A, &s.common);
  s.substituted.resize(lower.rows(), 4);
  if (s.factor == nullptr) throw std::runtime_error("CHOLMOD could not analyse the matrix");
}

PositiveDefiniteSolver::~PositiveDefiniteSolver() = default;

void PositiveDefiniteSolver::factorize(const Eigen::SparseMatrix<double>& lower) {
  Implementation& s = *implementation_;
  for (std::size_t k = 0; k < s.slots.size(); ++k) s.upper.valuePtr()[s.slots[k]] = lower.valuePtr()[k];
  cholmod_sparse A = view(s.upper, 1);
  cholmod_factorize(&A, s.factor, &s.common);
  s.requirePositive();
}

void PositiveDefiniteSolver::reserveUpdates(std::size_t count) {
  Implementation& s = *implementation_;
  s.starts.reserve(count + 1);
  s.rows.reserve(4 * count);
  s.values.reserve(4 * count);
  const std::size_t n = s.order.size();
  cholmod_allocate_work(n, n, s.common.maxrank * n, &s.common);
}

void PositiveDefiniteSolver::update(const std::vector<TetVector>& added,
                                    const std::vector<TetVector>& removed) {
  Implementation& s = *implementation_;
  s.update(added, true);
  s.update(removed, false);
  s.requirePositive();
}

CholeskyView PositiveDefiniteSolver::factor() const {
  const cholmod_factor& L = *implementation_->factor;
  return {static_cast<int>(L.n),         implementation_->order.data(), static_cast<const int*>(L.p),
          static_cast<const int*>(L.nz), static_cast<const int*>(L.i),  static_cast<const double*>(L.x)};
}

/// Uses the factor directly: cholmod_solve2 allocates in every call.
void PositiveDefiniteSolver::solve(const Points& B, Points* X) {
  const CholeskyView L = factor();
  SubstitutedRows& y = implementation_->substituted;
  for (int j = 0; j < L.count; ++j) y.row(j) << B.row(L.order[j]), 0.0;
  for (int j = 0; j < L.count; ++j) {
    const Eigen::RowVector4d row = y.row(j);
    for (int k = L.starts[j] + 1, end = L.starts[j] + L.row_counts[j]; k < end; ++k)
      y.row(L.rows[k]) -= L.values[k] * row;
  }
  for (int j = L.count - 1; j >= 0; --j) {
    Eigen::RowVector4d row = y.row(j) / L.values[L.starts[j]];
    for (int k = L.starts[j] + 1, end = L.starts[j] + L.row_counts[j]; k < end; ++k)
      row -= L.values[k] * y.row(L.rows[k]);
    y.row(j) = row;
  }
  X->resize(L.count, 3);
  for (int j = 0; j < L.count; ++j) X->row(L.order[j]) = y.row(j).head<3>();
}

}  // namespace softbody
