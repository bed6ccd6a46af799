#include "core/positive_definite_solver.h"

#include <cholmod.h>

#include <algorithm>
#include <array>
#include <stdexcept>
#include <utility>

namespace softbody {
namespace {

/// CHOLMOD's view of a compressed lower triangle; it borrows the memory and does not write to it.
cholmod_sparse view(const Eigen::SparseMatrix<double>& lower) {
  cholmod_sparse A{};
  A.nrow = static_cast<std::size_t>(lower.rows());
  A.ncol = static_cast<std::size_t>(lower.cols());
  A.nzmax = static_cast<std::size_t>(lower.nonZeros());
  A.p = const_cast<int*>(lower.outerIndexPtr());
  A.i = const_cast<int*>(lower.innerIndexPtr());
  A.x = const_cast<double*>(lower.valuePtr());
  A.stype = -1;
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
  std::vector<int> place;  ///< of a vertex in the factor's order
  std::vector<int> starts, rows;
  std::vector<double> values;  ///< of an update's columns
  cholmod_dense *B = nullptr, *X = nullptr, *Y = nullptr, *E = nullptr;

  Implementation() {
    cholmod_start(&common);
    common.print = 0;
    common.supernodal = CHOLMOD_SIMPLICIAL;
    common.final_ll = 0;  // L D L', which alone can be updated
    common.final_pack = 1;
    common.final_monotonic = 1;
  }
  ~Implementation() {
    for (cholmod_dense** workspace : {&B, &X, &Y, &E}) cholmod_free_dense(workspace, &common);
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

PositiveDefiniteSolver::PositiveDefiniteSolver(const Eigen::SparseMatrix<double>& lower)
    : implementation_(std::make_unique<Implementation>()) {
  Implementation& s = *implementation_;
  cholmod_sparse A = view(lower);
  s.factor = cholmod_analyze(&A, &s.common);
  s.B = cholmod_allocate_dense(A.nrow, 3, A.nrow, CHOLMOD_REAL, &s.common);
  if (s.factor == nullptr || s.B == nullptr) throw std::runtime_error("CHOLMOD could not analyse the matrix");
  const auto* order = static_cast<const int*>(s.factor->Perm);
  s.place.resize(A.nrow);
  for (std::size_t k = 0; k < A.nrow; ++k) s.place[static_cast<std::size_t>(order[k])] = static_cast<int>(k);
}

PositiveDefiniteSolver::~PositiveDefiniteSolver() = default;

void PositiveDefiniteSolver::factorize(const Eigen::SparseMatrix<double>& lower) {
  Implementation& s = *implementation_;
  cholmod_sparse A = view(lower);
  cholmod_factorize(&A, s.factor, &s.common);
  s.requirePositive();
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
  return {static_cast<int>(L.n),         static_cast<const int*>(L.Perm), static_cast<const int*>(L.p),
          static_cast<const int*>(L.nz), static_cast<const int*>(L.i),    static_cast<const double*>(L.x)};
}

void PositiveDefiniteSolver::solve(const Points& B, Points* X) {
  Implementation& s = *implementation_;
  Eigen::Map<Eigen::MatrixX3d>(static_cast<double*>(s.B->x), B.rows(), 3) = B;
  if (cholmod_solve2(CHOLMOD_A, s.factor, s.B, nullptr, &s.X, nullptr, &s.Y, &s.E, &s.common) == 0) {
    throw std::runtime_error("CHOLMOD could not solve the system");
  }
  *X = Eigen::Map<const Eigen::MatrixX3d>(static_cast<const double*>(s.X->x), B.rows(), 3);
}

}  // namespace softbody
