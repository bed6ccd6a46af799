#include "time_step/projective_dynamics.h"

#include <cmath>
#include <type_traits>

#include "elasticity/elastic_blocks.h"
#include "linear_solvers/global_step_solver.h"
#include "softbody_common/geometry/tet_geometry.h"
#include "tets/tet_matrix.h"
#include "time_step/force_balance.h"
#include "time_step/packed_potential.h"
#include "time_step/rigid_correction.h"

namespace softbody {

class ProjectiveDynamics::Precision {
 public:
  virtual ~Precision() = default;
  virtual StepReport minimize(const IncrementalPotential& potential, Points* x) = 0;
  virtual void restart() = 0;
  /// Elastic energy [J]; adds its gradient [N]. In double precision.
  virtual double addElasticity(const Points& x, Points* gradient) = 0;
};

namespace {

TetMatrix elasticMetric(const TetTopology& topology, const CorotatedElasticity& elasticity) {
  TetMatrix metric(topology.tets, topology.rest_vertices.rows());
  elasticity.addMetric(&metric);
  return metric;
}

/// Limit of consecutive updates, because their rounding errors add up.
constexpr int kMaxUpdatedFrames = 100;

/// The matrix of the global step, M / h^2 + elasticity + targets, and when to factor it. It changes with h,
/// with the targets' places in the body and with their weights, but not with their positions. Without a line
/// search it is followed exactly, and so are the stiff springs of contacts. Else L-BFGS needs no more than
/// its scale: the targets' part is a diagonal bound, and the factor stays as long as neither a vertex nor,
/// without its elasticity, a piece as a whole becomes more than twice or less than half as stiff.
class StepMetric {
 public:
  StepMetric(const TetTopology& topology, const CorotatedElasticity& elasticity, bool always_exact)
      : always_exact_(always_exact),
        pieces_(verticesOfPieces(topology.tets, topology.rest_vertices.rows())),
        metric_(elasticMetric(topology, elasticity)),
        elastic_(metric_.values()),
        elastic_diagonal_(metric_.lower().diagonal()) {
    added_.reserve(kMaxUpdates + 2);  // a coupled spring is two terms
    removed_.reserve(kMaxUpdates + 2);
  }

  const Eigen::SparseMatrix<double>& lower() const { return metric_.lower(); }

  /// The next factor does not depend on earlier ones.
  void forgetFactor() { has_factor_ = false; }

  /// Updates the solver's factor to the potential.
  template <typename T>
  void updateFactor(const IncrementalPotential& potential, GlobalStepSolver<T>* solver) {
    const bool exact = always_exact_ || potential.targets.hasContact();
    diagonal_ = potential.inertia;
    if (!exact) potential.targets.addMetricBound(&diagonal_);
    const bool few =
        has_factor_ && exact == is_exact_ && (exact ? fewTermsChange(potential) : fewVerticesChange());
    if (few && added_.empty() && removed_.empty()) return;
    has_factor_ = false;  // until the factor is complete
    if (few && updated_frames_ < kMaxUpdatedFrames) {
      ++updated_frames_;
      solver->update(added_, removed_);
    } else {
      updated_frames_ = 0;
      metric_.values() = elastic_;
      metric_.addToDiagonal(diagonal_);
      if (exact) potential.targets.addMetric(&metric_);
      solver->factorize(metric_.lower());
      factored_ = diagonal_;
    }
    if (exact) targets_ = potential.targets;
    is_exact_ = exact;
    has_factor_ = true;
  }

 private:
  static constexpr std::size_t kMaxUpdates = GlobalStepSolver<double>::kMaxUpdates;

  bool fewTermsChange(const IncrementalPotential& potential) {
    return factored_ == diagonal_ &&
           potential.targets.metricChanges(targets_, kMaxUpdates, &added_, &removed_);
  }

  /// Finds the vertices whose stiffness the factor no longer has the scale of, and takes over theirs.
  bool fewVerticesChange() {
    added_.clear();
    removed_.clear();
    for (const std::vector<int>& piece : pieces_) {
      double now = 0.0, before = 0.0;
      for (int v : piece) now += diagonal_[v], before += factored_[v];
      if (!areAlike(now, before)) return false;
    }
    for (int v = 0; v < static_cast<int>(diagonal_.size()); ++v) {
      if (areAlike(elastic_diagonal_[v] + diagonal_[v], elastic_diagonal_[v] + factored_[v])) continue;
      const double change = diagonal_[v] - factored_[v];
      (change > 0.0 ? added_ : removed_).push_back(vertexTerm(v, std::abs(change)));
      factored_[v] = diagonal_[v];
      if (added_.size() + removed_.size() > kMaxUpdates) return false;
    }
    return true;
  }

  static bool areAlike(double a, double b) { return a <= 2.0 * b && b <= 2.0 * a; }

  static TetVector vertexTerm(int vertex, double stiffness) {
    return {Eigen::Vector4i::Constant(vertex), {std::sqrt(stiffness), 0.0, 0.0, 0.0}};
  }

  const bool always_exact_;
  const std::vector<std::vector<int>> pieces_;  ///< vertices of each
  TetMatrix metric_;
  const Eigen::VectorXd elastic_;           ///< constant part of the values
  const Eigen::VectorXd elastic_diagonal_;  ///< #V [N/m]
  bool has_factor_ = false, is_exact_ = false;
  Eigen::VectorXd diagonal_;  ///< what the potential adds to the diagonal alone, #V [N/m]
  Eigen::VectorXd factored_;  ///< the same of the factor
  TargetEnergy targets_;      ///< of an exact factor
  std::vector<TetVector> added_, removed_;
  int updated_frames_ = 0;
};

/// @tparam T of positions, energy and gradient. @tparam M of the metric's factor.
template <typename T, typename M>
class InPrecision : public ProjectiveDynamics::Precision {
 public:
  InPrecision(const TetTopology& topology, const CorotatedElasticity& elasticity,
              const ProjectiveDynamicsOptions& options)
      : options_(options.minimizer),
        elasticity_(topology.rest_vertices, elasticity, options.simd),
        step_(topology.rest_vertices.rows(), options.simd),
        metric_(topology, elasticity, options.minimizer.history == 0),
        solver_(metric_.lower(), options.simd),
        rigid_(topology),
        minimizer_(paddedRows(topology.rest_vertices.rows())),
        x_(Rows<T>::Zero(paddedRows(topology.rest_vertices.rows()), 4)),
        double_elasticity_(topology.rest_vertices, elasticity, options.simd),
        double_x_(Rows<double>::Zero(x_.rows(), 4)),
        double_gradient_(double_x_) {}

  StepReport minimize(const IncrementalPotential& potential, Points* x) override {
    metric_.updateFactor(potential, &solver_);
    step_.set(potential, potential.prediction.colwise().mean());
    step_.toRows(*x, &x_);
    const auto energy = [&](const Rows<T>& trial, Rows<T>* gradient) {
      const auto add = [&](Rows<T>* sum) { return elasticity_.addTo(trial, sum); };
      return balance_.complete(potential, step_.evaluate(trial, gradient), add, gradient);
    };
    const auto solve = [this](const Rows<T>& B, Rows<T>* X) {
      if constexpr (std::is_same_v<T, M>)
        solver_.solve(B, X);
      else
        solver_.solveSparse(B, X);
    };
    const auto solve_contact = [&](const Rows<T>& B, Rows<T>* X) { rigid_.solve(solve, B, X); };
    const bool contact = potential.targets.hasContact();
    if (contact) rigid_.linearize(potential, *x);
    const StepReport report = contact ? minimizer_.minimize(energy, solve_contact, options_, &x_)
                                      : minimizer_.minimize(energy, solve, options_, &x_);
    step_.fromRows(x_, x);
    return report;
  }

  void restart() override { metric_.forgetFactor(); }

  double addElasticity(const Points& x, Points* gradient) override {
    double_x_.topLeftCorner(x.rows(), 3) = x;
    double_gradient_.setZero();
    const double energy = double_elasticity_.addTo(double_x_, &double_gradient_);
    *gradient += double_gradient_.topLeftCorner(x.rows(), 3);
    return energy;
  }

 private:
  const MinimizerOptions options_;
  ElasticBlocks<T> elasticity_;
  PackedPotential<T> step_;
  StepMetric metric_;
  GlobalStepSolver<M> solver_;
  ForceBalance<Rows<T>> balance_;
  RigidCorrection<T> rigid_;
  QuasiNewton<Rows<T>> minimizer_;
  Rows<T> x_;
  ElasticBlocks<double> double_elasticity_;
  Rows<double> double_x_, double_gradient_;
};

}  // namespace

ProjectiveDynamics::ProjectiveDynamics(const TetTopology& topology, const ElasticMaterials& materials,
                                       const ProjectiveDynamicsOptions& options)
    : elasticity_(topology.rest_vertices, topology.tets, materials) {
  // L-BFGS corrects the metric. Without it, in double precision, the metric is as precise as the result.
  const bool rough = options.minimizer.history > 0 &&
                     topology.rest_vertices.rows() > GlobalStepSolver<float>::kLargestInverse;
  if (options.single_precision)
    implementation_ = std::make_unique<InPrecision<float, float>>(topology, elasticity_, options);
  else if (rough)
    implementation_ = std::make_unique<InPrecision<double, float>>(topology, elasticity_, options);
  else
    implementation_ = std::make_unique<InPrecision<double, double>>(topology, elasticity_, options);
}

ProjectiveDynamics::~ProjectiveDynamics() = default;

StepReport ProjectiveDynamics::minimize(const IncrementalPotential& potential, Points* x) {
  return implementation_->minimize(potential, x);
}

void ProjectiveDynamics::restart(const Points& /*x*/) { implementation_->restart(); }

double ProjectiveDynamics::addElasticity(const Points& x, Points* gradient) const {
  return implementation_->addElasticity(x, gradient);
}

}  // namespace softbody
