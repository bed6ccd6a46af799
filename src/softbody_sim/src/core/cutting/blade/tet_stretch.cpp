#include "cutting/blade/tet_stretch.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "tets/tet_shape.h"

namespace softbody {
namespace {

/// F^T F = V diag(stretch^2) V^T, F the deformation gradient. With e the deformed direction, the stretch
/// e . F d changes by sum_v (e . dx_v) (d . grad N_v), N_v the shape functions.
TetStretch stretchOf(const TetTopology& volume, const Points& vertices, const Eigen::VectorXd& variances,
                     const Eigen::RowVector4i& corners) {
  const Eigen::Matrix3d inverse = edgesOf(volume.rest_vertices, corners).inverse();
  const Eigen::Matrix3d F = edgesOf(vertices, corners) * inverse;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(F.transpose() * F);
  TetStretch result{std::sqrt(std::max(0.0, solver.eigenvalues()[2])), solver.eigenvectors().col(2)};
  const Eigen::Vector4d slopes = shapeGradients(inverse) * result.direction;
  double variance = 0.0;
  for (int k = 0; k < 4; ++k) variance += slopes[k] * slopes[k] * variances[corners[k]];
  result.deviation = std::sqrt(variance);
  return result;
}

/// Per vertex, in one direction [m^2]. What is not observed is known by the material model alone, and the
/// deviations hold only as far as that does.
Eigen::VectorXd variancesOf(const MeshState& state) {
  constexpr double kDirections = 3.0, kLeastConfidence = 1e-3;
  Eigen::VectorXd variances = Eigen::VectorXd::Zero(state.vertices.rows());
  const auto count = static_cast<std::size_t>(variances.size());
  if (state.standard_deviation.size() != count || state.confidence.size() != count) return variances;
  for (std::size_t v = 0; v < count; ++v) {
    const double confidence = std::max<double>(state.confidence[v], kLeastConfidence);
    variances[static_cast<Eigen::Index>(v)] =
        std::pow(state.standard_deviation[v] / confidence, 2) / kDirections;
  }
  return variances;
}

}  // namespace

std::vector<TetStretch> tetStretches(const TetTopology& volume, const MeshState& state) {
  const Eigen::VectorXd variances = variancesOf(state);
  std::vector<TetStretch> stretches;
  stretches.reserve(static_cast<std::size_t>(volume.tets.rows()));
  for (Eigen::Index t = 0; t < volume.tets.rows(); ++t)
    stretches.push_back(stretchOf(volume, state.vertices, variances, volume.tets.row(t)));
  return stretches;
}

}  // namespace softbody
