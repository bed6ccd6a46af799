#include "estimation/load_estimator.h"

#include <Eigen/Dense>
#include <array>
#include <cmath>
#include <utility>

#include "estimation/deformation_modes.h"
#include "estimation/load_field.h"
#include "softbody_common/geometry/tet_geometry.h"
#include "softbody_common/protocol/target_limits.h"

namespace softbody {
namespace {

// Modes of a body: sections, limbs and their parts. More take longer and change little.
constexpr Eigen::Index kModes = 80;

std::vector<Eigen::VectorXi> verticesOf(const Tets& tets) {
  std::vector<Eigen::VectorXi> groups;
  for (const auto& tet : tets.rowwise()) groups.emplace_back(tet.transpose());
  return groups;
}

/// The transpose, with padded columns.
DenseRows<float> transposed(const DenseRows<double>& matrix) {
  DenseRows<float> result = DenseRows<float>::Zero(matrix.cols(), paddedColumns(matrix.rows()));
  result.leftCols(matrix.rows()) = matrix.transpose().cast<float>();
  return result;
}

}  // namespace

/// For the amplitudes of a piece's motions from the present shape.
struct LoadEstimator::Equations {
  Eigen::MatrixXd hessian;    ///< of springs and prior [N/m]
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
      place_in_piece_(piece_of_vertex_.size()),
      noise_(options.target_stiffness * kTargetAccuracy_m * kTargetAccuracy_m) {
  for (std::size_t piece = 0; piece < pieces_.size(); ++piece) {
    int place = 0;
    for (int v : pieces_[piece]) {
      piece_of_vertex_[static_cast<std::size_t>(v)] = piece;
      place_in_piece_[static_cast<std::size_t>(v)] = place++;
    }
  }
}

void LoadEstimator::prepare() {
  if (turned_) return;
  const std::vector<DeformationModes> modes =
      deformationModes(topology_, materials_.elastic, masses_, kModes);
  unknown_ = covariancesOfUnknownLoads(topology_, materials_, masses_, modes);
  for (const Eigen::MatrixXd& covariance : unknown_) unknown_precision_.push_back(inverseOf(covariance));
  for (const DeformationModes& piece : modes) {
    const Eigen::Index rows = piece.shapes.rows(), columns = TurnedModes::kRigid + piece.shapes.cols();
    stiffness_.push_back(piece.stiffness);
    motions_.push_back(DenseRows<double>::Zero(rows, paddedColumns(columns)));
    motions_.back().middleCols(TurnedModes::kRigid, piece.shapes.cols()) = piece.shapes;
    float_motions_.push_back(motions_.back().leftCols(columns).cast<float>());
  }
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

/// The motions of a piece at its present shape: only the rigid ones depend on it.
void LoadEstimator::setRigidMotions(std::size_t piece, const Points& vertices, const Rotations& rotations) {
  const TurnedModes::Rigid rigid = turned_->rigidMotions(pieces_[piece], vertices, rotations);
  motions_[piece].leftCols<TurnedModes::kRigid>() = rigid;
  float_motions_[piece].leftCols<TurnedModes::kRigid>() = rigid.cast<float>();
}

/// Sets the springs of curvature(), and the vertices that they act on.
void LoadEstimator::setCurvature(const TargetEnergy& springs, const Points& vertices) {
  curvature_->setZero();
  springs.addHessian(vertices, curvature_.get());
  measured_.assign(pieces_.size(), {});
  measured_place_.assign(piece_of_vertex_.size(), -1);
  for (const TargetEnergy::Spring& spring : springs.springs()) {
    for (int v : spring.vertices) {
      std::vector<int>& measured = measured_[piece_of_vertex_[static_cast<std::size_t>(v)]];
      if (measured_place_[static_cast<std::size_t>(v)] >= 0) continue;
      measured_place_[static_cast<std::size_t>(v)] = static_cast<int>(measured.size());
      measured.push_back(v);
    }
  }
}

/// The Hessian of the springs for the amplitudes of a piece's motions [N/m].
Eigen::MatrixXd LoadEstimator::curvature(std::size_t piece, const Rotations& rotations) const {
  const std::vector<int>& measured = measured_[piece];
  const DenseRows<double>& motions = motions_[piece];
  const auto rows = static_cast<Eigen::Index>(3 * measured.size());
  DenseRows<double> moved(rows, motions.cols()), curved = DenseRows<double>::Zero(rows, motions.cols());
  for (std::size_t k = 0; k < measured.size(); ++k) {
    const auto v = static_cast<std::size_t>(measured[k]);
    moved.middleRows<3>(3 * static_cast<Eigen::Index>(k)).noalias() =
        rotations[v] * motions.middleRows<3>(3 * place_in_piece_[v]);
  }
  for (Eigen::Index own = 0; own < rows; ++own) {
    const Eigen::Index column = 3 * measured[static_cast<std::size_t>(own / 3)] + own % 3;
    for (Eigen::SparseMatrix<double>::InnerIterator entry(curvature_->lower(), column); entry; ++entry) {
      const int place = measured_place_[static_cast<std::size_t>(entry.row() / 3)];
      if (place < 0 || entry.value() == 0.0) continue;
      const Eigen::Index other = 3 * place + entry.row() % 3;
      curved.row(other) += entry.value() * moved.row(own);
      if (other != own) curved.row(own) += entry.value() * moved.row(other);
    }
  }
  return symmetricProduct(moved, curved, float_motions_[piece].cols());
}

/// Forces along the motions of a piece.
Eigen::MatrixX3d LoadEstimator::along(std::size_t piece, const Rotations& rotations,
                                      const std::array<const Points*, 3>& forces) const {
  const std::vector<int>& vertices = pieces_[piece];
  Eigen::MatrixX3d turned(3 * static_cast<Eigen::Index>(vertices.size()), 3);
  for (std::size_t k = 0; k < vertices.size(); ++k) {
    const auto to_vertex = rotations[static_cast<std::size_t>(vertices[k])].transpose();
    for (std::size_t i = 0; i < forces.size(); ++i)
      turned.block<3, 1>(3 * static_cast<Eigen::Index>(k), static_cast<Eigen::Index>(i)) =
          to_vertex * forces[i]->row(vertices[k]).transpose();
  }
  return motions_[piece].leftCols(float_motions_[piece].cols()).transpose() * turned;
}

/// Energies are in units of J, and probabilities exp(-energy / noise). @param forces gradient of the springs;
/// balancing; the last loads [N].
LoadEstimator::Equations LoadEstimator::equationsOf(std::size_t piece, const Rotations& rotations,
                                                    const std::array<const Points*, 3>& forces,
                                                    const LoadEstimate& last, double elapsed_s) const {
  const auto stiffness = stiffness_[piece].asDiagonal();
  const Eigen::Index modes = stiffness_[piece].size();
  const Eigen::MatrixX3d acting = along(piece, rotations, forces);
  Equations equations{curvature(piece, rotations), -acting.col(0), acting.col(1).tail(modes)};
  const double keep = std::exp(-elapsed_s / options_.fade_s);
  const Eigen::VectorXd mean = keep * acting.col(2).tail(modes);
  Eigen::MatrixXd covariance = unknown_[piece];
  if (last.covariances.size() == pieces_.size() && last.covariances[piece].rows() == modes)
    covariance += keep * keep * (last.covariances[piece] - unknown_[piece]);
  const Eigen::MatrixXd precision = inverseOf(covariance);
  equations.hessian.bottomRightCorner(modes, modes) += noise_ * (stiffness * precision * stiffness);
  equations.hessian.diagonal().head(TurnedModes::kRigid).array() += looseness();
  equations.pull.tail(modes) -= noise_ * (stiffness * (precision * (equations.balancing - mean)));
  return equations;
}

/// @return the loads along the modes.
Eigen::VectorXd LoadEstimator::estimatePiece(std::size_t piece, const Rotations& rotations,
                                             const Equations& equations, LoadEstimate* estimate) const {
  const Eigen::Index modes = stiffness_[piece].size();
  const auto stiffness = stiffness_[piece].asDiagonal();
  const Eigen::MatrixXd inverse = inverseOf(equations.hessian);
  const Eigen::VectorXd loads = equations.balancing + stiffness * (inverse * equations.pull).tail(modes);
  estimate->covariances[piece] = noise_ * (stiffness * inverse.bottomRightCorner(modes, modes) * stiffness);
  const Eigen::VectorXd per_mass = motions_[piece].middleCols(TurnedModes::kRigid, modes) * loads;
  for (std::size_t k = 0; k < pieces_[piece].size(); ++k) {
    const int v = pieces_[piece][k];
    estimate->per_mass.row(v) =
        rotations[static_cast<std::size_t>(v)] * per_mass.segment<3>(3 * static_cast<Eigen::Index>(k));
  }
  return loads;
}

/// Curvature of the energy by a rigid motion of a piece, where nothing is measured [N/m].
double LoadEstimator::looseness() const {
  return noise_ / (ShapePosterior::kUnknown_m * ShapePosterior::kUnknown_m);
}

/// The mean square of the loads in units of those of which nothing is known, over the part that the
/// measurements determine (MacKay 1992, Bayesian interpolation, eq. 4.9), and one mode of usual loads beside
/// it.
double LoadEstimator::evidence(const std::vector<Eigen::VectorXd>& loads,
                               const LoadEstimate& estimate) const {
  double size = 0.0, determined = 0.0;
  for (std::size_t piece = 0; piece < pieces_.size(); ++piece) {
    size += loads[piece].dot(unknown_precision_[piece] * loads[piece]);
    determined += static_cast<double>(loads[piece].size()) -
                  unknown_precision_[piece].cwiseProduct(estimate.covariances[piece]).sum();
  }
  return (size + 1.0) / (determined + 1.0);
}

std::optional<ShapePosterior> LoadEstimator::update(const std::vector<Target>& targets,
                                                    const std::vector<Pin>& pins, const Points& vertices,
                                                    const Points& balancing, double elapsed_s,
                                                    LoadEstimate* estimate) {
  if (std::exchange(estimate->edited, false)) return std::nullopt;
  prepare();
  setSprings(targets, pins);
  setCurvature(springs_, vertices);
  Points pushed = Points::Zero(vertices.rows(), 3);
  springs_.addTo(vertices, &pushed);
  ShapePosterior posterior;
  std::vector<Equations> equations;
  std::vector<Eigen::VectorXd> loads;
  const LoadEstimate last = *estimate;
  const Points before = masses_.asDiagonal() * last.per_mass;
  estimate->covariances.resize(pieces_.size());
  const Rotations rotations = turned_->rotationsOf(vertices);
  for (std::size_t piece = 0; piece < pieces_.size(); ++piece) {
    setRigidMotions(piece, vertices, rotations);
    equations.push_back(equationsOf(piece, rotations, {&pushed, &balancing, &before}, last, elapsed_s));
    loads.push_back(estimatePiece(piece, rotations, equations.back(), estimate));
  }
  balance(vertices, &estimate->per_mass);
  // The model errs, like its prior, in proportion to the loads; a piece that nothing measures may be
  // anywhere. Targets of pinned pieces say nothing of the loads, but where the piece is.
  const double scale = evidence(loads, *estimate);
  const bool has_held = !measuring_held_.empty();
  if (has_held) setCurvature(springs_on_held_, vertices);
  for (std::size_t piece = 0; piece < pieces_.size(); ++piece) {
    Eigen::MatrixXd& hessian = equations[piece].hessian;
    if (has_held) hessian += curvature(piece, rotations);
    hessian.diagonal().head(TurnedModes::kRigid).array() += (scale - 1.0) * looseness();
    const DenseRows<double> root = std::sqrt(scale * noise_) * inverseRoot(hessian).leftCols(hessian.cols());
    posterior.pieces.push_back({&pieces_[piece], &float_motions_[piece], transposed(root)});
  }
  return posterior;
}

}  // namespace softbody
