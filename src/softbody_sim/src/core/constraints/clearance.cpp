#include "constraints/clearance.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace softbody {

void Clearance::set(const Points& reference, double distance_m) {
  reference_ = reference;
  distance_m_ = distance_m;
  deviation_m_ = 0.0;
}

/// The best rotation (Kabsch), without an allocation.
void Clearance::start(const Points& before) {
  const Eigen::RowVector3d from = reference_.colwise().mean(), to = before.colwise().mean();
  Eigen::Matrix3d products = Eigen::Matrix3d::Zero();
  for (Eigen::Index v = 0; v < before.rows(); ++v)
    products += (before.row(v) - to).transpose() * (reference_.row(v) - from);
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(products, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Eigen::Matrix3d R = svd.matrixU() * svd.matrixV().transpose();
  if (R.determinant() < 0.0)
    R = svd.matrixU() * Eigen::Vector3d(1.0, 1.0, -1.0).asDiagonal() * svd.matrixV().transpose();
  double largest = 0.0;  // squared
  for (Eigen::Index v = 0; v < before.rows(); ++v)
    largest = std::max(
        largest,
        (R * (reference_.row(v) - from).transpose() - (before.row(v) - to).transpose()).squaredNorm());
  deviation_m_ = std::sqrt(largest);
}

double Clearance::until(const Points& before, const Points& now) const {
  const Eigen::RowVector3d shift = (now - before).colwise().mean();
  double largest = 0.0;  // squared
  for (Eigen::Index v = 0; v < before.rows(); ++v)
    largest = std::max(largest, (now.row(v) - before.row(v) - shift).squaredNorm());
  return atStart() - 2.0 * std::sqrt(largest);
}

}  // namespace softbody
