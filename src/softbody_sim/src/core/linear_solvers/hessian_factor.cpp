#include "linear_solvers/hessian_factor.h"

#include <Eigen/CholmodSupport>
#include <Eigen/Dense>

namespace softbody {

class HessianFactor::Cholmod : public Eigen::CholmodDecomposition<Eigen::SparseMatrix<double>, Eigen::Lower> {
 public:
  Cholmod() {
    cholmod().print = 0;
    // By default CHOLMOD may also try METIS, which draws random numbers that threads share.
    cholmod().nmethods = 1;
    cholmod().method[0].ordering = CHOLMOD_AMD;
    // The supernodal mode starts threads, which cost more than they gain.
    setMode(Eigen::CholmodSimplicialLLt);
  }
  const cholmod_factor& factor() const { return *m_cholmodFactor; }
};

HessianFactor::HessianFactor(const Eigen::SparseMatrix<double>& lower)
    : cholmod_(std::make_unique<Cholmod>()) {
  cholmod_->analyzePattern(lower);
}

HessianFactor::~HessianFactor() = default;

bool HessianFactor::factorize(const Eigen::SparseMatrix<double>& lower) {
  cholmod_->factorize(lower);
  if (cholmod_->info() != Eigen::Success) return false;
  readPanels();
  return true;
}

void HessianFactor::readPanels() {
  const cholmod_factor& L = cholmod_->factor();
  const auto *starts = static_cast<const int*>(L.p), *counts = static_cast<const int*>(L.nz);
  const auto* rows = static_cast<const int*>(L.i);
  const auto* values = static_cast<const double*>(L.x);
  const auto* order = static_cast<const int*>(L.Perm);
  const auto size = static_cast<int>(L.n);
  // Column k + 1 has the rows of column k below its diagonal.
  const auto continues = [&](int k) {
    return counts[k + 1] == counts[k] - 1 && rows[starts[k] + 1] == k + 1;
  };
  panels_.clear();
  rows_.clear();
  values_.clear();
  for (int first = 0, width = 1; first < size; first += width, width = 1) {
    while (first + width < size && continues(first + width - 1)) ++width;
    panels_.push_back({first, width, static_cast<int>(rows_.size()), counts[first], values_.size()});
    rows_.insert(rows_.end(), rows + starts[first], rows + starts[first] + counts[first]);
    for (int column = 0; column < width; ++column) {
      const double* below = values + starts[first + column];
      values_.insert(values_.end(), static_cast<std::size_t>(column), 0.0f);
      values_.insert(values_.end(), below, below + counts[first + column]);
    }
  }
  order_.assign(order, order + size);
  y_.resize(size);
  gathered_.resize(size);
}

void HessianFactor::solve(const Rows<double>& B, Rows<double>* X) {
  using Matrix = Eigen::Map<const Eigen::MatrixXf>;
  // CHOLMOD numbers the coordinates of the vertices one after the other; a row here has a fourth number.
  const auto place = [](int k) { return 4 * (k / 3) + k % 3; };
  for (std::size_t k = 0; k < order_.size(); ++k)
    y_[static_cast<Eigen::Index>(k)] = static_cast<float>(B.data()[place(order_[k])]);
  for (const Panel& panel : panels_) {
    const Matrix L(values_.data() + panel.value_begin, panel.row_count, panel.width);
    auto own = y_.segment(panel.first, panel.width);
    L.topRows(panel.width).triangularView<Eigen::Lower>().solveInPlace(own);
    const int below = panel.row_count - panel.width;
    auto change = gathered_.head(below);
    change.noalias() = L.bottomRows(below) * own;
    const int* rows = rows_.data() + panel.row_begin + panel.width;
    for (int k = 0; k < below; ++k) y_[rows[k]] -= change[k];
  }
  for (auto panel = panels_.rbegin(); panel != panels_.rend(); ++panel) {
    const Matrix L(values_.data() + panel->value_begin, panel->row_count, panel->width);
    auto own = y_.segment(panel->first, panel->width);
    const int below = panel->row_count - panel->width;
    const int* rows = rows_.data() + panel->row_begin + panel->width;
    auto known = gathered_.head(below);
    for (int k = 0; k < below; ++k) known[k] = y_[rows[k]];
    own.noalias() -= L.bottomRows(below).transpose() * known;
    L.topRows(panel->width).triangularView<Eigen::Lower>().transpose().solveInPlace(own);
  }
  X->setZero();
  for (std::size_t k = 0; k < order_.size(); ++k)
    X->data()[place(order_[k])] = static_cast<double>(y_[static_cast<Eigen::Index>(k)]);
}

}  // namespace softbody
