#include "softbody_common/geometry/rigid_fit.h"

#include <Eigen/SVD>
#include <stdexcept>

namespace softbody {

Eigen::Isometry3d fitRigid(const Points& source, const Points& target, const Eigen::VectorXd& weights) {
  const Eigen::Index n = source.rows();
  if (target.rows() != n || (weights.size() != 0 && weights.size() != n)) {
    throw std::invalid_argument("fitRigid: sizes differ");
  }
  const Eigen::VectorXd w = weights.size() != 0 ? weights : Eigen::VectorXd::Ones(n);
  if (!source.allFinite() || !target.allFinite() || !w.allFinite()) {
    throw std::invalid_argument("fitRigid: a value is not finite");
  }
  if (n == 0 || w.minCoeff() < 0.0 || w.sum() <= 0.0)
    throw std::invalid_argument("fitRigid: no positive weight");

  const Eigen::RowVector3d source_mean = w.transpose() * source / w.sum();
  const Eigen::RowVector3d target_mean = w.transpose() * target / w.sum();
  const Eigen::Matrix3d correlation =
      (target.rowwise() - target_mean).transpose() * w.asDiagonal() * (source.rowwise() - source_mean);
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(correlation, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Eigen::Vector3d signs = Eigen::Vector3d::Ones();
  signs.z() = (svd.matrixU() * svd.matrixV().transpose()).determinant() < 0.0 ? -1.0 : 1.0;

  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.linear() = svd.matrixU() * signs.asDiagonal() * svd.matrixV().transpose();
  T.translation() = target_mean.transpose() - T.linear() * source_mean.transpose();
  return T;
}

Points transformed(const Points& points, const Eigen::Isometry3d& T) {
  return points.lazyProduct(T.linear().transpose()).rowwise() + T.translation().transpose();
}

}  // namespace softbody
