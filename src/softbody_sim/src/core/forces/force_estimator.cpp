#include "forces/force_estimator.h"

#include <Eigen/CholmodSupport>
#include <stdexcept>

#include "forces/force_patches.h"

namespace softbody {

struct ForceEstimator::Factor : Eigen::CholmodDecomposition<Eigen::SparseMatrix<double>, Eigen::Lower> {};

namespace {

// Time of the masses [s]: a force that the estimate leaves unbalanced moves the body by this time's square.
constexpr double kLongTime = 0.3;

// More places take longer, and noise does not let smaller ones be told apart.
constexpr std::size_t kMostPlaces = 100;

Eigen::VectorXd flat(const Points& points) { return points.reshaped<Eigen::RowMajor>(); }

double measurementCount(const TargetEnergy& measured) {
  double count = 0.0;
  for (const TargetEnergy::Spring& spring : measured.springs())
    count += spring.normal.isZero(0.0) ? 3.0 : 1.0;
  return count;
}

}  // namespace

ForceEstimator::ForceEstimator(const TetTopology& topology, Elasticity elasticity,
                               const ElasticMaterials& materials, const Eigen::VectorXd& masses,
                               double scale_n)
    : elasticity_(topology, elasticity, materials),
      slow_masses_(masses / (kLongTime * kLongTime)),
      scale_n_(scale_n),
      places_(topology, kMostPlaces),
      stiffness_(elasticity_.groups(), masses.size()),
      information_(elasticity_.groups(), masses.size()),
      factor_(std::make_unique<Factor>()) {
  factor_->cholmod().print = 0;
  factor_->setMode(Eigen::CholmodSupernodalLLt);
  factor_->analyzePattern(stiffness_.lower());
}

ForceEstimator::~ForceEstimator() = default;

Points ForceEstimator::LinearBody::moveUnder(const Eigen::VectorXd& forces) const {
  const Eigen::VectorXd move = still + compliance * forces;
  return move.reshaped<Eigen::RowMajor>(move.size() / 3, 3);
}

/// Factors the stiffness. @return the forces that are not in balance, #V by 3 [N].
Points ForceEstimator::linearize(const ObservedBalance& balance, const Points& x) {
  Points gradient = -balance.loads;
  elasticity_.addTo(x, &gradient);
  balance.contacts.addTo(x, &gradient);
  stiffness_.setZero();
  elasticity_.addHessian(x, &stiffness_);
  balance.contacts.addHessian(x, &stiffness_);
  Eigen::VectorXd diagonal = slow_masses_;
  for (std::size_t k = 0; k < balance.pins.size(); ++k) {
    const Pin& pin = balance.pins[k];
    diagonal[pin.vertex] += balance.pin_stiffness[k];
    gradient.row(pin.vertex) += balance.pin_stiffness[k] * (x.row(pin.vertex) - pin.position.transpose());
  }
  stiffness_.addToDiagonal(diagonal);
  factor_->factorize(stiffness_.lower());
  if (factor_->info() != Eigen::Success)
    throw std::runtime_error("the forces on the body cannot be found: its stiffness is not positive");
  return -gradient;
}

/// The matrix P. A pin carries all forces on its vertex, so the other vertices of the place share them.
Eigen::MatrixXd ForceEstimator::forcesOnPlaces(const std::vector<Pin>& pins) const {
  std::vector<double> shares = places_.shares;
  for (const Pin& pin : pins) shares[static_cast<std::size_t>(pin.vertex)] = 0.0;
  const auto count = static_cast<Eigen::Index>(places_.count());
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(3 * slow_masses_.size(), 3 * count);
  for (Eigen::Index place = 0; place < count; ++place) {
    double free = 0.0;
    for (int v : places_.vertices[static_cast<std::size_t>(place)])
      free += shares[static_cast<std::size_t>(v)];
    if (free == 0.0) continue;
    for (int v : places_.vertices[static_cast<std::size_t>(place)]) {
      for (int c = 0; c < 3; ++c)
        result(3 * v + c, 3 * place + c) = shares[static_cast<std::size_t>(v)] / free;
    }
  }
  return result;
}

/// @param still d without forces. @param compliance d by unit forces.
ForceEvidence ForceEstimator::evidence(const ObservedBalance& balance, const Points& x,
                                       const Eigen::VectorXd& still, const Eigen::MatrixXd& compliance) {
  information_.setZero();
  balance.measured.addHessian(x, &information_);
  const auto J = information_.lower().selfadjointView<Eigen::Lower>();
  Points slope = Points::Zero(x.rows(), 3);
  const double energy = balance.measured.addTo(x, &slope);
  const Eigen::VectorXd gradient = flat(slope), curved = J * still;
  ForceEvidence result;
  const Eigen::MatrixXd seen = J * compliance;
  result.G.resize(compliance.cols(), compliance.cols());
  result.G.triangularView<Eigen::Lower>() = compliance.transpose() * seen;
  result.G.triangularView<Eigen::StrictlyUpper>() = result.G.transpose();
  result.h = -compliance.transpose() * (gradient + curved);
  result.chi_square = 2.0 * energy + 2.0 * gradient.dot(still) + still.dot(curved);
  result.count = measurementCount(balance.measured);
  return result;
}

ForceEstimator::LinearBody ForceEstimator::linearBody(const ObservedBalance& balance, const Points& x) {
  const Eigen::VectorXd unbalanced = flat(linearize(balance, x));
  const Eigen::MatrixXd unit_forces = forcesOnPlaces(balance.pins);
  LinearBody body{factor_->solve(unbalanced), factor_->solve(unit_forces), {}};
  body.evidence = evidence(balance, x, body.still, body.compliance);
  return body;
}

/// The body is linearised around the noisy shape of the step, and then around a smooth one.
ForceEstimate ForceEstimator::estimate(const ObservedBalance& balance) {
  Points x = balance.vertices;
  const LinearBody first = linearBody(balance, x);
  x += first.moveUnder(smoothForces(first.evidence, scale_n_));
  const LinearBody body = linearBody(balance, x);
  const SparseForces forces = sparseForces(body.evidence, scale_n_);
  // Mean forces over several places are in no balance: under them, a free body would leave its place.
  ForceEstimate result = patchesOf(forces, places_, balance.vertices);
  x += body.moveUnder(forces.onPlaces(places_.count()));
  for (std::size_t k = 0; k < balance.pins.size(); ++k) {
    const Pin& pin = balance.pins[k];
    const Eigen::Vector3d stretch = x.row(pin.vertex).transpose() - pin.position;
    result.pins.push_back({balance.pin_stiffness[k] * stretch, Eigen::Vector3d::Zero()});
  }
  return result;
}

}  // namespace softbody
