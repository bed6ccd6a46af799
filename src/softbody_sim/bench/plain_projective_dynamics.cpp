#include "plain_projective_dynamics.h"

#include <Eigen/LU>
#include <Eigen/SVD>

#include "core/tet_shape.h"
#include "softbody_common/tet_geometry.h"

namespace softbody::bench {

PlainProjectiveDynamics::PlainProjectiveDynamics(const TetTopology& topology, const Lame& lame,
                                                 const StepPotential& potential)
    : tets_(topology.tets),
      volumes_(tetVolumes(topology.rest_vertices, topology.tets)),
      lame_(lame),
      projections_(static_cast<std::size_t>(tets_.rows())) {
  const Eigen::Index n = topology.rest_vertices.rows();
  std::vector<Eigen::Triplet<double>> entries;
  const auto add = [&entries](const auto& vertices, const Eigen::Matrix4d& block) {
    for (int a = 0; a < 4; ++a) {
      for (int b = 0; b < 4; ++b) entries.emplace_back(vertices[a], vertices[b], block(a, b));
    }
  };
  for (Eigen::Index v = 0; v < n; ++v) entries.emplace_back(v, v, potential.inertia[v]);
  for (Eigen::Index t = 0; t < tets_.rows(); ++t) {
    const Eigen::Matrix<double, 3, 4> G =
        shapeGradients(edgesOf(topology.rest_vertices, tets_.row(t)).inverse()).transpose();
    shape_gradients_.push_back(G);
    const double stiffness = (2.0 * lame_.mu + 3.0 * lame_.lambda) * volumes_[t];
    add(Eigen::Vector4i(tets_.row(t)), stiffness * G.transpose() * G);
  }
  for (const auto& spring : potential.targets.springs()) {
    add(spring.vertices, spring.stiffness * spring.barycentric * spring.barycentric.transpose());
  }
  Eigen::SparseMatrix<double> A(n, n);
  A.setFromTriplets(entries.begin(), entries.end());
  solver_.compute(A);
}

void PlainProjectiveDynamics::localStep(const Points& x) {
  Eigen::JacobiSVD<Eigen::Matrix3d> svd(3, 3, Eigen::ComputeFullU | Eigen::ComputeFullV);
  for (Eigen::Index t = 0; t < tets_.rows(); ++t) {
    Eigen::Matrix<double, 3, 4> corners;
    for (int k = 0; k < 4; ++k) corners.col(k) = x.row(tets_(t, k));
    const auto index = static_cast<std::size_t>(t);
    const Eigen::Matrix3d F = corners * shape_gradients_[index].transpose();
    svd.compute(F);
    Eigen::Matrix3d U = svd.matrixU();
    Eigen::Vector3d sigma = svd.singularValues();
    if (U.determinant() * svd.matrixV().determinant() < 0.0) {
      U.col(2) = -U.col(2);
      sigma[2] = -sigma[2];
    }
    const Eigen::Matrix3d R = U * svd.matrixV().transpose();
    projections_[index] = 2.0 * lame_.mu * R;
    if (lame_.lambda > 0.0) {
      // The nearest singular values that sum to 3.
      const Eigen::Vector3d nearest = sigma.array() - (sigma.sum() - 3.0) / 3.0;
      projections_[index] += 3.0 * lame_.lambda * U * nearest.asDiagonal() * svd.matrixV().transpose();
    }
  }
}

void PlainProjectiveDynamics::globalStep(const StepPotential& potential, Points* x) {
  right_side_ = potential.inertia.asDiagonal() * potential.prediction + potential.loads;
  for (Eigen::Index t = 0; t < tets_.rows(); ++t) {
    const auto index = static_cast<std::size_t>(t);
    const Eigen::Matrix<double, 3, 4> pull = volumes_[t] * projections_[index] * shape_gradients_[index];
    for (int k = 0; k < 4; ++k) right_side_.row(tets_(t, k)) += pull.col(k).transpose();
  }
  for (const auto& spring : potential.targets.springs()) {
    for (int k = 0; k < 4; ++k) {
      right_side_.row(spring.vertices[k]) +=
          spring.stiffness * spring.barycentric[k] * spring.position.transpose();
    }
  }
  *x = solver_.solve(right_side_);
}

void PlainProjectiveDynamics::iterate(const StepPotential& potential, Points* x) {
  localStep(*x);
  globalStep(potential, x);
}

}  // namespace softbody::bench
