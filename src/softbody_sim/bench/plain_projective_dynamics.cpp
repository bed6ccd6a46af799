#include "bench/plain_projective_dynamics.h"

#include <Eigen/LU>
#include <Eigen/SVD>

#include "softbody_common/geometry/tet_geometry.h"
#include "tets/tet_shape.h"

namespace softbody::bench {

namespace {

/// The sum of the projections of F onto its constraints, each with its weight [Pa].
class Projector {
 public:
  explicit Projector(const Lame& lame) : lame_(lame) {}

  Eigen::Matrix3d operator()(const Eigen::Matrix3d& F) {
    svd_.compute(F);
    Eigen::Matrix3d U = svd_.matrixU();
    Eigen::Vector3d sigma = svd_.singularValues();
    if (U.determinant() * svd_.matrixV().determinant() < 0.0) {
      U.col(2) = -U.col(2);
      sigma[2] = -sigma[2];
    }
    const Eigen::Matrix3d R = U * svd_.matrixV().transpose();
    Eigen::Matrix3d sum = 2.0 * lame_.mu * R;
    if (lame_.lambda > 0.0) {
      // The nearest singular values with sum 3.
      const Eigen::Vector3d nearest = sigma.array() - (sigma.sum() - 3.0) / 3.0;
      sum += 3.0 * lame_.lambda * U * nearest.asDiagonal() * svd_.matrixV().transpose();
    }
    return sum;
  }

 private:
  Lame lame_;
  Eigen::JacobiSVD<Eigen::Matrix3d> svd_{3, 3, Eigen::ComputeFullU | Eigen::ComputeFullV};
};

}  // namespace

PlainProjectiveDynamics::PlainProjectiveDynamics(const TetTopology& topology, const Lame& lame,
                                                 const IncrementalPotential& potential, double smoothing)
    : tets_(topology.tets),
      volumes_((1.0 - smoothing) * tetVolumes(topology.rest_vertices, topology.tets)),
      lame_(lame),
      projections_(static_cast<std::size_t>(tets_.rows())) {
  const Eigen::Index n = topology.rest_vertices.rows();
  for (Eigen::Index v = 0; v < n; ++v) entries_.emplace_back(v, v, potential.inertia[v]);
  addTets(topology.rest_vertices);
  if (smoothing > 0.0) addPatches(topology.rest_vertices, smoothing);
  for (const auto& spring : potential.targets.springs()) {
    for (int a = 0; a < 4; ++a) {
      for (int b = 0; b < 4; ++b) {
        entries_.emplace_back(spring.vertices[a], spring.vertices[b],
                              spring.stiffness * spring.barycentric[a] * spring.barycentric[b]);
      }
    }
  }
  Eigen::SparseMatrix<double> A(n, n);
  A.setFromTriplets(entries_.begin(), entries_.end());
  entries_ = {};
  solver_.compute(A);
}

template <typename Vertices, typename Gradients>
void PlainProjectiveDynamics::addToMatrix(const Vertices& vertices, double volume,
                                          const Gradients& gradients) {
  const double stiffness = (2.0 * lame_.mu + 3.0 * lame_.lambda) * volume;
  for (Eigen::Index a = 0; a < gradients.cols(); ++a) {
    for (Eigen::Index b = 0; b < gradients.cols(); ++b)
      entries_.emplace_back(vertices[a], vertices[b], stiffness * gradients.col(a).dot(gradients.col(b)));
  }
}

void PlainProjectiveDynamics::addTets(const Points& rest_vertices) {
  for (Eigen::Index t = 0; t < tets_.rows(); ++t) {
    const Eigen::Matrix<double, 3, 4> gradients =
        shapeGradients(edgesOf(rest_vertices, tets_.row(t)).inverse()).transpose();
    shape_gradients_.push_back(gradients);
    addToMatrix(tets_.row(t), volumes_[t], gradients);
  }
}

void PlainProjectiveDynamics::addPatches(const Points& rest_vertices, double smoothing) {
  const SmoothedGradients smoothed = smoothedGradients(rest_vertices, tets_, lame_);
  for (Eigen::Index v = 0; v < smoothed.volumes.size(); ++v) {
    const int first = smoothed.first[v], last = smoothed.first[v + 1];
    patches_.push_back({{smoothed.vertices.begin() + first, smoothed.vertices.begin() + last},
                        smoothed.gradients.middleRows(first, last - first).transpose(),
                        smoothing * smoothed.volumes[v],
                        Eigen::Matrix3d::Zero()});
    addToMatrix(patches_.back().vertices, patches_.back().volume, patches_.back().gradients);
  }
}

void PlainProjectiveDynamics::localStep(const Points& x) {
  Projector project(lame_);
  for (Eigen::Index t = 0; t < tets_.rows(); ++t) {
    Eigen::Matrix<double, 3, 4> corners;
    for (int k = 0; k < 4; ++k) corners.col(k) = x.row(tets_(t, k));
    const auto index = static_cast<std::size_t>(t);
    projections_[index] = project(corners * shape_gradients_[index].transpose());
  }
  for (Patch& patch : patches_) {
    Eigen::Matrix3d F = Eigen::Matrix3d::Zero();
    for (std::size_t i = 0; i < patch.vertices.size(); ++i) {
      F += x.row(patch.vertices[i]).transpose() *
           patch.gradients.col(static_cast<Eigen::Index>(i)).transpose();
    }
    patch.projection = project(F);
  }
}

void PlainProjectiveDynamics::globalStep(const IncrementalPotential& potential, Points* x) {
  right_side_ = potential.inertia.asDiagonal() * potential.prediction + potential.loads;
  for (Eigen::Index t = 0; t < tets_.rows(); ++t) {
    const auto index = static_cast<std::size_t>(t);
    const Eigen::Matrix<double, 3, 4> pull = volumes_[t] * projections_[index] * shape_gradients_[index];
    for (int k = 0; k < 4; ++k) right_side_.row(tets_(t, k)) += pull.col(k).transpose();
  }
  for (const Patch& patch : patches_) {
    const Eigen::Matrix3d stress = patch.volume * patch.projection;
    for (std::size_t i = 0; i < patch.vertices.size(); ++i) {
      right_side_.row(patch.vertices[i]) +=
          (stress * patch.gradients.col(static_cast<Eigen::Index>(i))).transpose();
    }
  }
  for (const auto& spring : potential.targets.springs()) {
    for (int k = 0; k < 4; ++k) {
      right_side_.row(spring.vertices[k]) +=
          spring.stiffness * spring.barycentric[k] * spring.position.transpose();
    }
  }
  *x = solver_.solve(right_side_);
}

void PlainProjectiveDynamics::iterate(const IncrementalPotential& potential, Points* x) {
  localStep(*x);
  globalStep(potential, x);
}

}  // namespace softbody::bench
