#include "time_step/free_motion.h"

#include <Eigen/Dense>

#include "elasticity/rotation.h"
#include "softbody_common/geometry/rigid_motion.h"
#include "softbody_common/geometry/tet_geometry.h"

namespace softbody {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

/// The turn about an axis that has an angular momentum. A piece without extent does not turn.
Vector3d spinOf(const Matrix3d& inertia, const Vector3d& momentum) {
  const Eigen::LDLT<Matrix3d> factor(inertia);
  if (!(factor.rcond() > 1e-9)) return Vector3d::Zero();  // as flat as rounding
  return factor.solve(momentum);
}

}  // namespace

FreeMotion::FreeMotion(const TetTopology& topology, const Eigen::VectorXd& masses)
    : pieces_(verticesOfPieces(topology.tets, topology.rest_vertices.rows())), masses_(masses) {}

Vector3d FreeMotion::centerOf(const std::vector<int>& piece, const Points& x) const {
  Vector3d sum = Vector3d::Zero();
  double mass = 0.0;
  for (const int v : piece) {
    sum += masses_[v] * x.row(v).transpose();
    mass += masses_[v];
  }
  return sum / mass;
}

Matrix3d FreeMotion::inertiaOf(const std::vector<int>& piece, const Points& x, const Vector3d& center) const {
  Matrix3d inertia = Matrix3d::Zero();
  for (const int v : piece) {
    const Vector3d arm = x.row(v).transpose() - center;
    inertia += masses_[v] * (arm.squaredNorm() * Matrix3d::Identity() - arm * arm.transpose());
  }
  return inertia;
}

void FreeMotion::advance(const Points& velocity, double time_s, Points* x) const {
  for (const std::vector<int>& piece : pieces_) {
    const Vector3d center = centerOf(piece, *x), drift = centerOf(piece, velocity);
    Vector3d momentum = Vector3d::Zero();
    for (const int v : piece) {
      const Vector3d arm = x->row(v).transpose() - center;
      momentum += masses_[v] * arm.cross(Vector3d(velocity.row(v)));
    }
    const Vector3d spin = spinOf(inertiaOf(piece, *x, center), momentum);
    const Matrix3d R = rotationBy(time_s * spin);
    for (const int v : piece) {
      const Vector3d arm = x->row(v).transpose() - center;
      const Vector3d rest = velocity.row(v).transpose() - drift - spin.cross(arm);
      x->row(v) = center + time_s * drift + R * (arm + time_s * rest);
    }
  }
}

void FreeMotion::setVelocity(const Points& before, const Points& after, double time_s,
                             Points* velocity) const {
  for (const std::vector<int>& piece : pieces_) {
    const Vector3d from = centerOf(piece, before), to = centerOf(piece, after);
    Matrix3d covariance = Matrix3d::Zero(), R;
    for (const int v : piece)
      covariance += masses_[v] * (after.row(v).transpose() - to) * (before.row(v) - from.transpose());
    extractRotation(covariance, &R);
    const Eigen::AngleAxisd turn(R);
    const Vector3d mean_spin = turn.angle() / time_s * turn.axis();
    // The angular momentum stays while the piece turns; so the spin of one that tumbles changes.
    const Vector3d spin = spinOf(inertiaOf(piece, after, to), inertiaOf(piece, before, from) * mean_spin);
    for (const int v : piece) {
      const Vector3d arm = after.row(v).transpose() - to;
      const Vector3d rest = arm - R * (before.row(v).transpose() - from);
      velocity->row(v) = (to - from + rest) / time_s + spin.cross(arm);
    }
  }
}

}  // namespace softbody
