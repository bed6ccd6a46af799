#include "time_step/rigid_descent.h"

#include <Eigen/Dense>
#include <cmath>

#include "softbody_common/tet_geometry.h"

namespace softbody {
namespace {

// Stiffness added to each motion, as a share of the stiffest: a motion that nothing measures stays small.
constexpr double kRegularization = 1e-9;

Eigen::Vector3d pointOf(const TargetEnergy::Spring& spring, const Points& x) {
  Eigen::Vector3d point = Eigen::Vector3d::Zero();
  for (int k = 0; k < 4; ++k) point += spring.barycentric[k] * x.row(spring.vertices[k]).transpose();
  return point;
}

bool isClosed(const TargetEnergy::Spring& spring, const Eigen::Vector3d& point) {
  return spring.normal.dot(point - spring.position) < 0.0;
}

Eigen::Isometry3d motionAbout(const Eigen::Vector3d& center, const Eigen::Matrix<double, 6, 1>& motion) {
  const Eigen::Vector3d turn = motion.head<3>();
  const double angle = turn.norm();
  Eigen::Isometry3d result = Eigen::Isometry3d::Identity();
  if (angle > 0.0) result.linear() = Eigen::AngleAxisd(angle, turn / angle).toRotationMatrix();
  result.translation() = center + motion.tail<3>() - result.linear() * center;
  return result;
}

}  // namespace

RigidDescent::RigidDescent(const TetTopology& topology)
    : pieces_(verticesOfPieces(topology.tets, topology.rest_vertices.rows())),
      piece_of_vertex_(static_cast<std::size_t>(topology.rest_vertices.rows())) {
  for (std::size_t p = 0; p < pieces_.size(); ++p)
    for (const int v : pieces_[p]) piece_of_vertex_[static_cast<std::size_t>(v)] = p;
}

void RigidDescent::Motion::addCurvature(const Eigen::Vector3d& point, const Eigen::Vector3d& direction,
                                        double stiffness) {
  Vector6d row;
  row << (point - center).cross(direction), direction;
  curvature.selfadjointView<Eigen::Lower>().rankUpdate(row, stiffness);
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
    motion.curvature.setZero();
    for (const int v : pieces_[p]) {
      const Eigen::Vector3d point = x.row(v), force = gradient_.row(v);
      motion.addGradient(point, force);
      for (int k = 0; k < 3; ++k) motion.addCurvature(point, Eigen::Vector3d::Unit(k), potential.inertia[v]);
    }
  }
}

void RigidDescent::addSprings(const TargetEnergy& targets, const Points& free, const Points& x) {
  for (const TargetEnergy::Spring& spring : targets.springs()) {
    Motion& motion = motions_[piece_of_vertex_[static_cast<std::size_t>(spring.vertices[0])]];
    const Eigen::Vector3d point = pointOf(spring, x);
    if (spring.isFriction()) {
      // The curvature is a multiple s P of a projection, so it is the sum of its columns' squares by s.
      const Eigen::Matrix3d curvature = TargetEnergy::curvatureAt(spring, x);
      const double scale = curvature.squaredNorm() / curvature.trace();
      for (int k = 0; k < 3 && scale > 0.0; ++k) motion.addCurvature(point, curvature.col(k), 1.0 / scale);
    } else if (spring.normal.isZero(0.0)) {
      for (int k = 0; k < 3; ++k) motion.addCurvature(point, Eigen::Vector3d::Unit(k), spring.stiffness);
    } else if (!spring.one_sided || isClosed(spring, point)) {
      motion.addCurvature(point, spring.normal, spring.stiffness);
    } else if (isClosed(spring, pointOf(spring, free))) {
      // It will act: the step ends where it does, not short of its plane.
      const double gap = spring.normal.dot(point - spring.position);
      motion.addCurvature(point, spring.normal, spring.stiffness);
      motion.addGradient(point, spring.stiffness * gap * spring.normal);
    }
  }
}

/// A full Newton step. @param x where gradient_ was evaluated.
void RigidDescent::move(const IncrementalPotential& potential, const Points& free, Points* x) {
  motions_.resize(pieces_.size());
  addVertices(potential, *x);
  addSprings(potential.targets, free, *x);
  for (std::size_t p = 0; p < pieces_.size(); ++p) {
    Motion& motion = motions_[p];
    // Turns and shifts have different units, so each is compared with its own kind.
    for (int first : {0, 3}) {
      auto diagonal = motion.curvature.diagonal().segment<3>(first);
      diagonal.array() += kRegularization * diagonal.maxCoeff();
    }
    const Vector6d step = -motion.curvature.selfadjointView<Eigen::Lower>().ldlt().solve(motion.gradient);
    const Eigen::Isometry3d T = motionAbout(motion.center, step);
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
  constexpr int kMaxSteps = 8;
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
