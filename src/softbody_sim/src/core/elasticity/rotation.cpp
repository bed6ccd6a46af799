#include "elasticity/rotation.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <cmath>

namespace softbody {
namespace {

Eigen::Matrix3d cofactors(const Eigen::Matrix3d& F) {
  Eigen::Matrix3d C;
  C.col(0) = F.col(1).cross(F.col(2));
  C.col(1) = F.col(2).cross(F.col(0));
  C.col(2) = F.col(0).cross(F.col(1));
  return C;
}

/// tr(R(q)^T F) = q^T K q for the unit quaternion q = (w, x, y, z) (Horn 1987): R belongs to the largest
/// eigenvalue.
double extractByEigenvector(const Eigen::Matrix3d& F, Eigen::Matrix3d* R) {
  const Eigen::Vector3d axial(F(2, 1) - F(1, 2), F(0, 2) - F(2, 0), F(1, 0) - F(0, 1));
  Eigen::Matrix4d K;
  K(0, 0) = F.trace();
  K.block<3, 1>(1, 0) = axial;
  K.block<1, 3>(0, 1) = axial.transpose();
  K.block<3, 3>(1, 1) = F + F.transpose() - F.trace() * Eigen::Matrix3d::Identity();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix4d> solver(K);
  const Eigen::Vector4d q = solver.eigenvectors().col(3);
  *R = Eigen::Quaterniond(q[0], q[1], q[2], q[3]).normalized().toRotationMatrix();
  return solver.eigenvalues()[3];
}

}  // namespace

double extractRotation(const Eigen::Matrix3d& F, Eigen::Matrix3d* R) {
  const double squared_norm = F.squaredNorm();
  const Eigen::Matrix3d C = cofactors(F);
  const double determinant = F.col(0).dot(C.col(0));
  const double norm = std::sqrt(squared_norm);

  // (s^2 - |F|^2)^2 - 8 det(F) s - 4 |cof F|^2 = 0 has the largest root tr(R^T F) <= sqrt(3) |F|. Newton's
  // method from above converges to it monotonically.
  constexpr int kMaxIterations = 12;
  const double cofactor_term = 4.0 * C.squaredNorm();
  double s = std::sqrt(3.0) * norm;
  double slope = 0.0;
  for (int iteration = 0; iteration < kMaxIterations; ++iteration) {
    const double gap = s * s - squared_norm;
    slope = 4.0 * s * gap - 8.0 * determinant;
    // A slope of zero, within rounding, is a double root: two singular values sum to zero, and any rotation
    // in their plane is optimal.
    if (!(slope > 1e-2 * squared_norm * norm)) return extractByEigenvector(F, R);
    const double step = (gap * gap - 8.0 * determinant * s - cofactor_term) / slope;
    s -= step;
    if (std::abs(step) < 1e-12 * s) break;
    if (iteration + 1 == kMaxIterations) return extractByEigenvector(F, R);
  }
  const double kappa = 0.5 * (s * s - squared_norm);
  const double zeta = kappa * s - determinant;
  *R = ((kappa + squared_norm) * F + s * C - F * (F.transpose() * F)) / zeta;
  return s;
}

}  // namespace softbody
