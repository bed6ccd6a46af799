#include "time_step/rigid_descent.h"

#include <Eigen/Dense>
#include <cmath>

#include "softbody_common/geometry/rigid_motion.h"
#include "softbody_common/geometry/tet_geometry.h"

namespace softbody {
namespace {

// Stiffness added to each motion, as a share of the stiffest: a motion that nothing measures stays small.
constexpr double kRegularization = 1e-9;

Eigen::Vector3d pointOf(const Eigen::Vector4i& vertices, const Eigen::Vector4d& barycentric,
                        const Points& x) {
  Eigen::Vector3d point = Eigen::Vector3d::Zero();
  for (int k = 0; k < 4; ++k) point += barycentric[k] * x.row(vertices[k]).transpose();
  return point;
}

/// Of the spring's point in front of its plane [m].
double gapOf(const TargetEnergy::Spring& spring, const Points& x) {
  Eigen::Vector3d place = pointOf(spring.vertices, spring.barycentric, x);
  if (spring.isCoupled()) place -= pointOf(spring.other_vertices, spring.other_barycentric, x);
  return spring.normal.dot(place - spring.position);
}

}  // namespace

RigidDescent::RigidDescent(const TetTopology& topology)
    : pieces_(verticesOfPieces(topology.tets, topology.rest_vertices.rows())),
      piece_of_vertex_(static_cast<std::size_t>(topology.rest_vertices.rows())) {
  for (std::size_t p = 0; p < pieces_.size(); ++p)
    for (const int v : pieces_[p]) piece_of_vertex_[static_cast<std::size_t>(v)] = p;
}

RigidDescent::Matrix63d RigidDescent::Motion::slopes(const Eigen::Vector3d& point) const {
  Matrix63d result;
  result << crossMatrix(point - center), Eigen::Matrix3d::Identity();
  return result;
}

void RigidDescent::Motion::addGradient(const Eigen::Vector3d& point, const Eigen::Vector3d& force) {
  gradient.head<3>() += (point - center).cross(force);
  gradient.tail<3>() += force;
}

void RigidDescent::addVertices(const IncrementalPotential& potential, const Points& x) {
  for (std::size_t p = 0; p < pieces_.size(); ++p) {
    Motion& motion = motions_[p];
    motion.center.setZero();
    for (const int v : pieces_[p]) motion.center += x.row(v).transpose();
    motion.center /= static_cast<double>(pieces_[p].size());
    motion.gradient.setZero();
    double stiffness = 0.0;
    Eigen::Vector3d first_moment = Eigen::Vector3d::Zero();
    Eigen::Matrix3d second_moment = Eigen::Matrix3d::Zero();
    for (const int v : pieces_[p]) {
      const Eigen::Vector3d point = x.row(v), arm = point - motion.center, force = gradient_.row(v);
      motion.addGradient(point, force);
      stiffness += potential.inertia[v];
      first_moment += potential.inertia[v] * arm;
      second_moment += potential.inertia[v] * arm * arm.transpose();
    }
    const Eigen::Matrix3d mixed = crossMatrix(first_moment);
    motion.curvature << second_moment.trace() * Eigen::Matrix3d::Identity() - second_moment, mixed,
        mixed.transpose(), stiffness * Eigen::Matrix3d::Identity();
  }
}

void RigidDescent::addSprings(const TargetEnergy& targets, const Points& free, const Points& x) {
  for (const TargetEnergy::Spring& spring : targets.springs()) {
    const bool is_plane = !spring.isFriction() && !spring.normal.isZero(0.0);
    if (!is_plane) {
      addCurvature(spring, x, TargetEnergy::curvatureAt(spring, x));
      continue;
    }
    const Eigen::Matrix3d curvature = spring.stiffness * spring.normal * spring.normal.transpose();
    if (!spring.one_sided || gapOf(spring, x) < 0.0) {
      addCurvature(spring, x, curvature);
    } else if (gapOf(spring, free) < 0.0) {
      // It will act: the step ends where it does, not short of its plane.
      addCurvature(spring, x, curvature);
      addGradient(spring, x, spring.stiffness * gapOf(spring, x) * spring.normal);
    }
  }
}

void RigidDescent::addCurvature(const TargetEnergy::Spring& spring, const Points& x,
                                const Eigen::Matrix3d& curvature) {
  const std::size_t piece = piece_of_vertex_[static_cast<std::size_t>(spring.vertices[0])];
  const auto add = [&](std::size_t p, const Matrix63d& slopes) {
    motions_[p].curvature += slopes * curvature * slopes.transpose();
  };
  const Matrix63d slopes = motions_[piece].slopes(pointOf(spring.vertices, spring.barycentric, x));
  if (!spring.isCoupled()) return add(piece, slopes);
  const std::size_t other = piece_of_vertex_[static_cast<std::size_t>(spring.other_vertices[0])];
  const Matrix63d opposite =
      -motions_[other].slopes(pointOf(spring.other_vertices, spring.other_barycentric, x));
  if (other == piece) return add(piece, slopes + opposite);
  add(piece, slopes);
  add(other, opposite);
  if (piece > other)
    couplingOf(piece, other) += slopes * curvature * opposite.transpose();
  else
    couplingOf(other, piece) += opposite * curvature * slopes.transpose();
}

void RigidDescent::addGradient(const TargetEnergy::Spring& spring, const Points& x,
                               const Eigen::Vector3d& force) {
  const auto add = [&](const Eigen::Vector4i& vertices, const Eigen::Vector4d& barycentric,
                       const Eigen::Vector3d& part) {
    Motion& motion = motions_[piece_of_vertex_[static_cast<std::size_t>(vertices[0])]];
    motion.addGradient(pointOf(vertices, barycentric, x), part);
  };
  add(spring.vertices, spring.barycentric, force);
  if (spring.isCoupled()) add(spring.other_vertices, spring.other_barycentric, -force);
}

RigidDescent::Matrix6d& RigidDescent::couplingOf(std::size_t row_piece, std::size_t column_piece) {
  for (Coupling& coupling : couplings_)
    if (coupling.row_piece == row_piece && coupling.column_piece == column_piece) return coupling.curvature;
  couplings_.push_back({row_piece, column_piece, Matrix6d::Zero()});
  return couplings_.back().curvature;
}

/// A Newton step of all motions.
void RigidDescent::findSteps() {
  const auto size = static_cast<Eigen::Index>(6 * motions_.size());
  steps_.resize(size);
  if (!couplings_.empty()) curvature_.setZero(size, size);
  for (std::size_t p = 0; p < motions_.size(); ++p) {
    Motion& motion = motions_[p];
    // Turns and shifts have different units, so each is compared with its own kind.
    for (int first : {0, 3}) {
      auto diagonal = motion.curvature.diagonal().segment<3>(first);
      diagonal.array() += kRegularization * diagonal.maxCoeff();
    }
    const auto place = static_cast<Eigen::Index>(6 * p);
    if (couplings_.empty()) {
      steps_.segment<6>(place) =
          -motion.curvature.selfadjointView<Eigen::Lower>().ldlt().solve(motion.gradient);
    } else {
      curvature_.block<6, 6>(place, place) = motion.curvature;
      steps_.segment<6>(place) = -motion.gradient;
    }
  }
  if (couplings_.empty()) return;
  for (const Coupling& coupling : couplings_)
    curvature_.block<6, 6>(static_cast<Eigen::Index>(6 * coupling.row_piece),
                           static_cast<Eigen::Index>(6 * coupling.column_piece)) = coupling.curvature;
  factor_.compute(curvature_);
  steps_ = factor_.solve(steps_);
}

/// A full Newton step. @param x where gradient_ was evaluated.
void RigidDescent::move(const IncrementalPotential& potential, const Points& free, Points* x) {
  motions_.resize(pieces_.size());
  couplings_.clear();
  addVertices(potential, *x);
  addSprings(potential.targets, free, *x);
  findSteps();
  for (std::size_t p = 0; p < pieces_.size(); ++p) {
    const auto step = steps_.segment<6>(static_cast<Eigen::Index>(6 * p));
    const Eigen::Isometry3d T = rigidMotion(step.head<3>(), step.tail<3>(), motions_[p].center);
    for (const int v : pieces_[p]) x->row(v) = T * Eigen::Vector3d(x->row(v));
  }
}

bool RigidDescent::descend(const IncrementalPotential& potential, const Points& free, Points* x) {
  gradient_.resize(x->rows(), 3);
  moved_ = *x;
  const double before = potential.evaluate(*x, &gradient_);
  move(potential, free, &moved_);
  if (!(potential.evaluate(moved_, &gradient_) < before)) return false;
  x->swap(moved_);
  return true;
}

void RigidDescent::settle(const IncrementalPotential& potential, const Points& free, Points* x) {
  constexpr int kMaxSteps = 8;          // a bound; contacts come and go between them
  constexpr double kNoticeable = 1e-6;  // share of the energy
  gradient_.resize(x->rows(), 3);
  lowest_ = moved_ = *x;
  double lowest = potential.evaluate(*x, &gradient_), before = lowest;
  for (int step = 0; step < kMaxSteps; ++step) {
    move(potential, step == 0 ? free : moved_, &moved_);
    const double energy = potential.evaluate(moved_, &gradient_);
    if (energy < lowest) {
      lowest = energy;
      lowest_ = moved_;
    }
    if (std::abs(energy - before) <= kNoticeable * std::abs(before)) break;
    before = energy;
  }
  x->swap(lowest_);
}

}  // namespace softbody
