#include "core/positive_definite_solver.h"

#include <cholmod.h>

#include <stdexcept>

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
  cholmod_dense *B = nullptr, *X = nullptr, *Y = nullptr, *E = nullptr;

  Implementation() {
    cholmod_start(&common);
    common.print = 0;
    common.supernodal = CHOLMOD_SIMPLICIAL;
    common.final_ll = 1;  // LDL' would accept an indefinite matrix
    common.final_pack = 1;
    common.final_monotonic = 1;
  }
  ~Implementation() {
    for (cholmod_dense** workspace : {&B, &X, &Y, &E}) cholmod_free_dense(workspace, &common);
    cholmod_free_factor(&factor, &common);
    cholmod_finish(&common);
  }
  Implementation(const Implementation&) = delete;
  Implementation& operator=(const Implementation&) = delete;
};

PositiveDefiniteSolver::PositiveDefiniteSolver(const Eigen::SparseMatrix<double>& lower)
    : implementation_(std::make_unique<Implementation>()) {
  Implementation& s = *implementation_;
  cholmod_sparse A = view(lower);
  s.factor = cholmod_analyze(&A, &s.common);
  s.B = cholmod_allocate_dense(A.nrow, 3, A.nrow, CHOLMOD_REAL, &s.common);
  if (s.factor == nullptr || s.B == nullptr) throw std::runtime_error("CHOLMOD could not analyse the matrix");
}

PositiveDefiniteSolver::~PositiveDefiniteSolver() = default;

void PositiveDefiniteSolver::factorize(const Eigen::SparseMatrix<double>& lower) {
  Implementation& s = *implementation_;
  cholmod_sparse A = view(lower);
  cholmod_factorize(&A, s.factor, &s.common);
  if (s.common.status != CHOLMOD_OK) throw std::runtime_error("the system matrix is not positive definite");
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
