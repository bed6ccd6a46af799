#include "constraints/clearance.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace softbody {

void Clearance::set(const Points& reference, double distance_m) {
  reference_ = reference;
  distance_m_ = distance_m;
}

/// The best rotation (Kabsch), without an allocation.
double Clearance::at(const Points& x) const {
  const Eigen::RowVector3d from = reference_.colwise().mean(), to = x.colwise().mean();
  Eigen::Matrix3d products = Eigen::Matrix3d::Zero();
  for (Eigen::Index v = 0; v < x.rows(); ++v)
    products += (x.row(v) - to).transpose() * (reference_.row(v) - from);
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(products, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Eigen::Matrix3d R = svd.matrixU() * svd.matrixV().transpose();
  if (R.determinant() < 0.0)
    R = svd.matrixU() * Eigen::Vector3d(1.0, 1.0, -1.0).asDiagonal() * svd.matrixV().transpose();
  double largest = 0.0;  // squared
  for (Eigen::Index v = 0; v < x.rows(); ++v)
    largest = std::max(
        largest, (R * (reference_.row(v) - from).transpose() - (x.row(v) - to).transpose()).squaredNorm());
  return distance_m_ - 2.0 * std::sqrt(largest);
}

}  // namespace softbody
