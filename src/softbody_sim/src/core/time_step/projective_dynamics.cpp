#include "time_step/projective_dynamics.h"

#include "elasticity/elastic_blocks.h"
#include "linear_solvers/global_step_solver.h"
#include "tets/tet_matrix.h"
#include "time_step/force_balance.h"
#include "time_step/packed_potential.h"
#include "time_step/rigid_correction.h"

namespace softbody {

class ProjectiveDynamics::Precision {
 public:
  virtual ~Precision() = default;
  virtual StepReport minimize(const IncrementalPotential& potential, Points* x) = 0;
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

/// The matrix of the global step, M / h^2 + elasticity + targets. It changes with h, with the targets' places
/// in the body and with their weights, but not with their positions.
class StepMetric {
 public:
  StepMetric(const TetTopology& topology, const CorotatedElasticity& elasticity)
      : metric_(elasticMetric(topology, elasticity)), elastic_(metric_.values()) {
    added_.reserve(kMaxUpdates + 2);  // a coupled spring is two terms
    removed_.reserve(kMaxUpdates + 2);
  }

  const Eigen::SparseMatrix<double>& lower() const { return metric_.lower(); }

  /// Updates the solver's factor to the potential.
  template <typename T>
  void updateFactor(const IncrementalPotential& potential, GlobalStepSolver<T>* solver) {
    const bool few = has_factor_ && inertia_ == potential.inertia &&
                     potential.targets.metricChanges(targets_, kMaxUpdates, &added_, &removed_);
    if (few && added_.empty() && removed_.empty()) return;
    has_factor_ = false;  // until the factor is complete
    if (few && updated_frames_ < kMaxUpdatedFrames) {
      ++updated_frames_;
      solver->update(added_, removed_);
    } else {
      updated_frames_ = 0;
      metric_.values() = elastic_;
      metric_.addToDiagonal(potential.inertia);
      potential.targets.addMetric(&metric_);
      solver->factorize(metric_.lower());
    }
    inertia_ = potential.inertia;
    targets_ = potential.targets;
    has_factor_ = true;
  }

 private:
  static constexpr std::size_t kMaxUpdates = GlobalStepSolver<double>::kMaxUpdates;

  TetMatrix metric_;
  const Eigen::VectorXd elastic_;  ///< constant part of the values
  bool has_factor_ = false;
  Eigen::VectorXd inertia_;  ///< of the factor
  TargetEnergy targets_;     ///< of the factor
  std::vector<TetVector> added_, removed_;
  int updated_frames_ = 0;
};

template <typename T>
class InPrecision : public ProjectiveDynamics::Precision {
 public:
  InPrecision(const TetTopology& topology, const CorotatedElasticity& elasticity,
              const ProjectiveDynamicsOptions& options)
      : options_(options.minimizer),
        elasticity_(topology.rest_vertices, elasticity, options.simd),
        step_(topology.rest_vertices.rows(), options.simd),
        metric_(topology, elasticity),
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
    const auto solve = [this](const Rows<T>& B, Rows<T>* X) { solver_.solve(B, X); };
    const auto solve_contact = [&](const Rows<T>& B, Rows<T>* X) { rigid_.solve(solve, B, X); };
    const bool contact = potential.targets.hasContact();
    if (contact) rigid_.linearize(potential, *x);
    const StepReport report = contact ? minimizer_.minimize(energy, solve_contact, options_, &x_)
                                      : minimizer_.minimize(energy, solve, options_, &x_);
    step_.fromRows(x_, x);
    return report;
  }

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
  GlobalStepSolver<T> solver_;
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
  if (options.single_precision)
    implementation_ = std::make_unique<InPrecision<float>>(topology, elasticity_, options);
  else
    implementation_ = std::make_unique<InPrecision<double>>(topology, elasticity_, options);
}

ProjectiveDynamics::~ProjectiveDynamics() = default;

StepReport ProjectiveDynamics::minimize(const IncrementalPotential& potential, Points* x) {
  return implementation_->minimize(potential, x);
}

double ProjectiveDynamics::addElasticity(const Points& x, Points* gradient) const {
  return implementation_->addElasticity(x, gradient);
}

}  // namespace softbody
