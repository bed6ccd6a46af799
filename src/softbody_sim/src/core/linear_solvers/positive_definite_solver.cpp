#include "linear_solvers/positive_definite_solver.h"

#include <cholmod.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <mutex>
#include <new>
#include <stdexcept>
#include <utility>

namespace softbody {
namespace {

/// For more rows, METIS finds better orders than AMD, and supernodes are faster than columns, by more than
/// updates save (bench_projective_dynamics, `factor` and `update`).
constexpr Eigen::Index kManyRows = 4000;

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
  cholmod_factor* structure = nullptr;  ///< supernodes without values
  cholmod_factor* factor = nullptr;     ///< L D L' in columns, or L L' in supernodes
  bool is_large;
  /// A in the factor's order. CHOLMOD would copy a matrix that it has to permute or transpose.
  Eigen::SparseMatrix<double> upper;
  std::vector<int> slots;         ///< positions of the values of A's lower triangle in `upper`
  std::vector<int> order, place;  ///< vertex at each position of the factor's order, and its inverse
  std::vector<int> starts, rows;
  std::vector<double> values;            ///< of an update's columns
  mutable std::vector<double> gathered;  ///< values of a supernode
  mutable std::vector<int> row_places;   ///< places of the factor's rows in a supernode
  Points permuted, below;

  explicit Implementation(bool large) : is_large(large) {
    cholmod_start(&common);
    common.print = 0;
    common.final_ll = 0;  // only L D L' can be updated
    common.final_pack = 1;
    common.final_monotonic = 1;
  }
  ~Implementation() {
    cholmod_free_factor(&structure, &common);
    cholmod_free_factor(&factor, &common);
    cholmod_finish(&common);
  }
  /// L D L' accepts an indefinite matrix.
  void requirePositive() const {
    bool positive = common.status == CHOLMOD_OK;
    if (positive && !factor->is_super) {
      const auto* starts_of_L = static_cast<const int*>(factor->p);
      const auto* values_of_L = static_cast<const double*>(factor->x);
      for (std::size_t j = 0; positive && j < factor->n; ++j) positive = values_of_L[starts_of_L[j]] > 0.0;
    }
    if (!positive) throw std::runtime_error("the system matrix is not positive definite");
  }
  cholmod_factor* analyze(const Eigen::SparseMatrix<double>& matrix, int triangle, int mode);
  void findOrder(const Eigen::SparseMatrix<double>& lower);
  void permute(const Eigen::SparseMatrix<double>& lower);
  void update(const std::vector<TetVector>& columns, bool add);
  void gather(const Supernode& supernode) const;

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
      if (value == 0.0) continue;  // a term of fewer vertices
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

cholmod_factor* PositiveDefiniteSolver::Implementation::analyze(const Eigen::SparseMatrix<double>& matrix,
                                                                int triangle, int mode) {
  cholmod_sparse A = view(matrix, triangle);
  common.supernodal = mode;
  cholmod_factor* analysis = cholmod_analyze(&A, &common);
  if (analysis == nullptr) throw std::runtime_error("CHOLMOD could not analyse the matrix");
  return analysis;
}

void PositiveDefiniteSolver::Implementation::findOrder(const Eigen::SparseMatrix<double>& lower) {
  static std::mutex one_at_a_time;  // METIS seeds and draws the random numbers of the process
  const std::lock_guard lock(one_at_a_time);
  common.nmethods = 1;
  common.method[0].ordering = is_large ? CHOLMOD_METIS : CHOLMOD_AMD;
  cholmod_factor* analysis = analyze(lower, -1, CHOLMOD_SIMPLICIAL);
  const auto* permutation = static_cast<const int*>(analysis->Perm);
  order.assign(permutation, permutation + analysis->n);
  cholmod_free_factor(&analysis, &common);
  place.resize(order.size());
  for (std::size_t k = 0; k < order.size(); ++k)
    place[static_cast<std::size_t>(order[k])] = static_cast<int>(k);
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

/// The supernode's values from the columns of L D L'.
void PositiveDefiniteSolver::Implementation::gather(const Supernode& supernode) const {
  const auto* starts_of_L = static_cast<const int*>(factor->p);
  const auto* counts_of_L = static_cast<const int*>(factor->nz);
  const auto* rows_of_L = static_cast<const int*>(factor->i);
  const auto* values_of_L = static_cast<const double*>(factor->x);
  const int height = supernode.width() + supernode.below();
  gathered.assign(static_cast<std::size_t>(height * supernode.width()), 0.0);
  for (int k = 0; k < height; ++k) row_places[static_cast<std::size_t>(supernode.rows[k])] = k;
  for (int column = 0; column < supernode.width(); ++column) {
    const int start = starts_of_L[supernode.first + column];
    const double scale = std::sqrt(values_of_L[start]);
    double* column_values = gathered.data() + static_cast<std::ptrdiff_t>(column) * height;
    column_values[column] = scale;
    for (int k = start + 1; k < start + counts_of_L[supernode.first + column]; ++k)
      column_values[row_places[static_cast<std::size_t>(rows_of_L[k])]] = scale * values_of_L[k];
  }
}

PositiveDefiniteSolver::PositiveDefiniteSolver(const Eigen::SparseMatrix<double>& lower)
    : implementation_(std::make_unique<Implementation>(lower.rows() > kManyRows)) {
  Implementation& s = *implementation_;
  s.findOrder(lower);
  s.permute(lower);
  s.common.method[0].ordering = CHOLMOD_NATURAL;
  s.common.postorder = 0;
  s.structure = s.analyze(s.upper, 1, CHOLMOD_SUPERNODAL);
  if (!s.is_large) s.factor = s.analyze(s.upper, 1, CHOLMOD_SIMPLICIAL);
  s.row_places.resize(s.order.size());
}

PositiveDefiniteSolver::~PositiveDefiniteSolver() = default;

void PositiveDefiniteSolver::factorize(const Eigen::SparseMatrix<double>& lower) {
  Implementation& s = *implementation_;
  for (std::size_t k = 0; k < s.slots.size(); ++k) s.upper.valuePtr()[s.slots[k]] = lower.valuePtr()[k];
  if (s.is_large && (s.factor == nullptr || !s.factor->is_super)) {  // an update has made columns of it
    cholmod_free_factor(&s.factor, &s.common);
    s.factor = cholmod_copy_factor(s.structure, &s.common);
    if (s.factor == nullptr) throw std::bad_alloc();
  }
  cholmod_sparse A = view(s.upper, 1);
  s.common.supernodal = s.is_large ? CHOLMOD_SUPERNODAL : CHOLMOD_SIMPLICIAL;
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

const std::vector<int>& PositiveDefiniteSolver::order() const { return implementation_->order; }

int PositiveDefiniteSolver::supernodeCount() const {
  return static_cast<int>(implementation_->structure->nsuper);
}

Supernode PositiveDefiniteSolver::supernode(int index) const {
  const Implementation& s = *implementation_;
  const auto* columns = static_cast<const int*>(s.structure->super) + index;
  const auto* row_begins = static_cast<const int*>(s.structure->pi) + index;
  const int* rows = static_cast<const int*>(s.structure->s) + row_begins[0];
  const int height = row_begins[1] - row_begins[0], width = columns[1] - columns[0];
  const auto at = [&](const double* values) { return Supernode{columns[0], rows, {values, height, width}}; };
  if (s.factor->is_super)
    return at(static_cast<const double*>(s.factor->x) + static_cast<const int*>(s.factor->px)[index]);
  s.gather(at(nullptr));
  return at(s.gathered.data());
}

/// Uses the factor directly: cholmod_solve2 allocates in every call.
void PositiveDefiniteSolver::solve(const Points& B, Points* X) {
  Implementation& s = *implementation_;
  s.permuted = B(s.order, Eigen::all);
  for (int index = 0; index < supernodeCount(); ++index) {
    const Supernode node = supernode(index);
    auto own = s.permuted.middleRows(node.first, node.width());
    node.values.topRows(node.width()).triangularView<Eigen::Lower>().solveInPlace(own);
    s.below.noalias() = node.values.bottomRows(node.below()) * own;
    for (int k = 0; k < node.below(); ++k) s.permuted.row(node.rows[node.width() + k]) -= s.below.row(k);
  }
  for (int index = supernodeCount() - 1; index >= 0; --index) {
    const Supernode node = supernode(index);
    auto own = s.permuted.middleRows(node.first, node.width());
    s.below.resize(node.below(), 3);
    for (int k = 0; k < node.below(); ++k) s.below.row(k) = s.permuted.row(node.rows[node.width() + k]);
    own.noalias() -= node.values.bottomRows(node.below()).transpose() * s.below;
    node.values.topRows(node.width()).triangularView<Eigen::Lower>().transpose().solveInPlace(own);
  }
  X->resize(B.rows(), 3);
  (*X)(s.order, Eigen::all) = s.permuted;
}

}  // namespace softbody
