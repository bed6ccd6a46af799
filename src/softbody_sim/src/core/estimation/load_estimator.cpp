#include "estimation/load_estimator.h"

#include <Eigen/Dense>
#include <cmath>
#include <utility>

#include "estimation/load_field.h"
#include "softbody_common/tet_geometry.h"

namespace softbody {
namespace {

// Modes of a body: sections, limbs and their parts. More take longer and change little.
constexpr Eigen::Index kModes = 80;

std::vector<Eigen::VectorXi> verticesOf(const Tets& tets) {
  std::vector<Eigen::VectorXi> groups;
  for (const auto& tet : tets.rowwise()) groups.emplace_back(tet.transpose());
  return groups;
}

/// The product of a symmetric matrix and others; rows stay in the cache. @param lower its lower triangle.
TurnedModes::Motions timesSymmetric(const Eigen::SparseMatrix<double>& lower,
                                    const TurnedModes::Motions& motions) {
  TurnedModes::Motions product = TurnedModes::Motions::Zero(motions.rows(), motions.cols());
  for (Eigen::Index column = 0; column < lower.outerSize(); ++column) {
    for (Eigen::SparseMatrix<double>::InnerIterator entry(lower, column); entry; ++entry) {
      if (entry.value() == 0.0) continue;  // most vertices are not measured
      product.row(entry.row()) += entry.value() * motions.row(column);
      if (entry.row() != column) product.row(column) += entry.value() * motions.row(entry.row());
    }
  }
  return product;
}

Eigen::MatrixXd inverseOf(const Eigen::MatrixXd& positive) {
  return positive.llt().solve(Eigen::MatrixXd::Identity(positive.rows(), positive.rows()));
}

}  // namespace

/// Of the loads along the modes.
struct LoadEstimator::Prior {
  Eigen::VectorXd mean;
  Eigen::MatrixXd precision;  ///< inverse of the covariance
};

/// For the amplitudes of the motions from the present shape.
struct LoadEstimator::Equations {
  Eigen::MatrixXd hessian;    ///< of springs and prior, lower triangle [N/m]
  Eigen::VectorXd pull;       ///< minus the gradient
  Eigen::VectorXd balancing;  ///< forces along the modes that hold the body in its present shape
};

LoadEstimator::LoadEstimator(const TetTopology& topology, const TetMaterials& materials,
                             const Eigen::VectorXd& masses, const Options& options)
    : topology_(topology),
      materials_(materials),
      masses_(masses),
      options_(options),
      pieces_(verticesOfPieces(topology.tets, masses.size())),
      piece_of_vertex_(static_cast<std::size_t>(masses.size())),
      noise_(options.target_stiffness * options.target_accuracy_m * options.target_accuracy_m) {
  for (std::size_t piece = 0; piece < pieces_.size(); ++piece) {
    for (int v : pieces_[piece]) piece_of_vertex_[static_cast<std::size_t>(v)] = piece;
  }
}

void LoadEstimator::prepare() {
  if (turned_) return;
  modes_ = deformationModes(topology_, materials_.elastic, masses_, kModes);
  unknown_ = covarianceOfUnknownLoads(topology_, materials_, masses_, modes_);
  unknown_precision_ = inverseOf(unknown_);
  turned_ = std::make_unique<TurnedModes>(topology_);
  curvature_ = std::make_unique<BlockTetMatrix>(verticesOf(topology_.tets), masses_.size());
}

/// Removes the loads that would accelerate the piece as a rigid body.
void LoadEstimator::balancePiece(const std::vector<int>& piece, const Points& vertices, Points* loads) const {
  double mass = 0.0;
  Eigen::Vector3d center = Eigen::Vector3d::Zero(), force = Eigen::Vector3d::Zero();
  for (int v : piece) {
    mass += masses_[v];
    center += masses_[v] * vertices.row(v).transpose();
    force += masses_[v] * loads->row(v).transpose();
  }
  center /= mass;
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();
  Eigen::Vector3d torque = Eigen::Vector3d::Zero();
  for (int v : piece) {
    const Eigen::Vector3d arm = vertices.row(v).transpose() - center;
    inertia += masses_[v] * (arm.squaredNorm() * Eigen::Matrix3d::Identity() - arm * arm.transpose());
    torque += masses_[v] * arm.cross(loads->row(v).transpose());
  }
  const Eigen::Vector3d spin = inertia.ldlt().solve(torque);
  for (int v : piece) {
    const Eigen::Vector3d arm = vertices.row(v).transpose() - center;
    loads->row(v) -= (force / mass + spin.cross(arm)).transpose();
  }
}

void LoadEstimator::balance(const Points& vertices, Points* loads) const {
  for (const std::vector<int>& piece : pieces_) balancePiece(piece, vertices, loads);
}

/// The springs of the targets that measure pieces without pins, and of the others.
void LoadEstimator::setSprings(const std::vector<Target>& targets, const std::vector<Pin>& pins) {
  std::vector<bool> held(pieces_.size(), false);
  for (const Pin& pin : pins) held[piece_of_vertex_[static_cast<std::size_t>(pin.vertex)]] = true;
  measuring_.clear();
  measuring_held_.clear();
  for (const Target& target : targets) {
    if (target.kind == TargetKind::kPrior) continue;
    const int vertex = topology_.tets(target.place.tet, 0);
    (held[piece_of_vertex_[static_cast<std::size_t>(vertex)]] ? measuring_held_ : measuring_)
        .push_back(target);
  }
  springs_.set(measuring_, topology_.tets, options_.target_stiffness);
  springs_on_held_.set(measuring_held_, topology_.tets, options_.target_stiffness);
}

/// The Hessian of springs for the amplitudes of motions, lower triangle [N/m].
Eigen::MatrixXd LoadEstimator::curvature(const TargetEnergy& springs, const Points& vertices,
                                         const Motions& motions) {
  curvature_->setZero();
  springs.addHessian(vertices, curvature_.get());
  const Motions curved = timesSymmetric(curvature_->lower(), motions);
  Eigen::MatrixXd hessian = Eigen::MatrixXd::Zero(motions.cols(), motions.cols());
  hessian.triangularView<Eigen::Lower>() = motions.transpose() * curved;
  return hessian;
}

/// The prior of the loads along the modes.
LoadEstimator::Prior LoadEstimator::priorOf(const LoadEstimate& estimate, const Eigen::VectorXd& loads,
                                            double elapsed_s) const {
  const double keep = std::exp(-elapsed_s / options_.fade_s);
  Eigen::MatrixXd covariance = unknown_;
  if (estimate.covariance.rows() == unknown_.rows())
    covariance += keep * keep * (estimate.covariance - unknown_);
  return {keep * loads, inverseOf(covariance)};
}

/// Energies are in units of J, and probabilities exp(-energy / noise).
LoadEstimator::Equations LoadEstimator::equationsAt(const Points& vertices, const Points& balancing,
                                                    const Motions& motions, double elapsed_s,
                                                    const LoadEstimate& estimate) {
  const Eigen::Index modes = modes_.stiffness.size();
  const auto along = [&](const Points& forces) {
    return Eigen::VectorXd(motions.transpose() * Eigen::VectorXd(forces.reshaped<Eigen::RowMajor>()));
  };
  Points pushed = Points::Zero(vertices.rows(), 3);
  springs_.addTo(vertices, &pushed);
  Equations equations{curvature(springs_, vertices, motions), -along(pushed), along(balancing).tail(modes)};
  const Prior prior =
      priorOf(estimate, along(masses_.asDiagonal() * estimate.per_mass).tail(modes), elapsed_s);
  const auto stiffness = modes_.stiffness.asDiagonal();
  equations.hessian.bottomRightCorner(modes, modes) += noise_ * (stiffness * prior.precision * stiffness);
  equations.hessian.diagonal().head(turned_->rigidCount()).array() += looseness();
  equations.pull.tail(modes) -= noise_ * (stiffness * (prior.precision * (equations.balancing - prior.mean)));
  return equations;
}

/// Curvature of the energy by a rigid motion of a piece, where nothing is measured [N/m].
double LoadEstimator::looseness() const {
  return noise_ / (ShapePosterior::kUnknown_m * ShapePosterior::kUnknown_m);
}

/// The mean square of the loads in units of those of which nothing is known, over the part that the
/// measurements determine (MacKay 1992, Bayesian interpolation, eq. 4.9), and one mode of usual loads beside
/// it.
double LoadEstimator::evidence(const Eigen::VectorXd& loads, const Eigen::MatrixXd& covariance) const {
  const double determined =
      static_cast<double>(loads.size()) - unknown_precision_.cwiseProduct(covariance).sum();
  return (loads.dot(unknown_precision_ * loads) + 1.0) / (determined + 1.0);
}

std::optional<ShapePosterior> LoadEstimator::update(const std::vector<Target>& targets,
                                                    const std::vector<Pin>& pins, const Points& vertices,
                                                    const Points& balancing, double elapsed_s,
                                                    LoadEstimate* estimate) {
  if (std::exchange(estimate->edited, false)) return std::nullopt;
  prepare();
  setSprings(targets, pins);
  ShapePosterior posterior;
  turned_->at(vertices, modes_.shapes, &posterior.motions);
  Equations equations = equationsAt(vertices, balancing, posterior.motions, elapsed_s, *estimate);
  const Eigen::Index modes = modes_.stiffness.size();
  const auto stiffness = modes_.stiffness.asDiagonal();
  const Eigen::MatrixXd inverse = inverseOf(equations.hessian);
  const Eigen::VectorXd loads = equations.balancing + stiffness * (inverse * equations.pull).tail(modes);
  estimate->covariance = noise_ * (stiffness * inverse.bottomRightCorner(modes, modes) * stiffness);
  const Eigen::VectorXd per_mass = posterior.motions.rightCols(modes) * loads;
  estimate->per_mass = per_mass.reshaped<Eigen::RowMajor>(vertices.rows(), 3);
  balance(vertices, &estimate->per_mass);
  if (!measuring_held_.empty())  // they say nothing of the loads, but where the piece is
    equations.hessian += curvature(springs_on_held_, vertices, posterior.motions);
  // The model errs, like its prior, in proportion to the loads; a piece that nothing measures may be
  // anywhere.
  const double scale = evidence(loads, estimate->covariance);
  equations.hessian.diagonal().head(turned_->rigidCount()).array() += (scale - 1.0) * looseness();
  posterior.covariance = scale * noise_ * inverseOf(equations.hessian);
  return posterior;
}

}  // namespace softbody
