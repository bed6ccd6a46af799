#include "elasticity/strain_smoothing.h"

#include <algorithm>

#include <Eigen/LU>
#include <Eigen/SparseCore>
#include <array>

#include "softbody_common/tet_geometry.h"
#include "tets/tet_shape.h"

namespace softbody {

double volumeSmoothing(double poisson_ratio) {
  constexpr double kUnsmoothed = 0.3, kHarmless = 0.2;
  const auto ratio = [](double nu) { return 2.0 * nu / (1.0 - 2.0 * nu); };  // lambda / mu
  const double softer = (1.0 - 2.0 * poisson_ratio) / (1.0 - 2.0 * kHarmless);
  return 1.0 - kUnsmoothed * std::min(1.0, softer * ratio(kHarmless) / ratio(poisson_ratio));
}

EnergyShare tetShare(const Lame& lame, const Smoothing& smoothing) {
  const double share = 1.0 - smoothing.strain;
  return {share, {lame.mu, lame.lambda * ((1.0 - smoothing.volume) / share)}};
}

EnergyShare patchShare(const Lame& lame, const Smoothing& smoothing) {
  const double share = smoothing.strain > 0.0 ? smoothing.strain : smoothing.volume;
  if (lame.mu * smoothing.strain + lame.lambda * smoothing.volume == 0.0) return {0.0, lame};
  return {share, {lame.mu * (smoothing.strain / share), lame.lambda * (smoothing.volume / share)}};
}

SmoothedGradients smoothedGradients(const Points& rest_vertices, const Tets& tets) {
  const Eigen::Index count = rest_vertices.rows();
  const Eigen::VectorXd tet_volumes = tetVolumes(rest_vertices, tets);
  SmoothedGradients smoothed;
  smoothed.volumes.setZero(count);
  std::array<std::vector<Eigen::Triplet<double>>, 3> weighted;  // row v: gradients times volumes
  for (Eigen::Index t = 0; t < tets.rows(); ++t) {
    const double share = 0.25 * tet_volumes[t];
    const Eigen::Matrix<double, 4, 3> gradients =
        share * shapeGradients(edgesOf(rest_vertices, tets.row(t)).inverse());
    for (int a = 0; a < 4; ++a) {
      smoothed.volumes[tets(t, a)] += share;
      for (int b = 0; b < 4; ++b) {
        for (int k = 0; k < 3; ++k) weighted[k].emplace_back(tets(t, a), tets(t, b), gradients(b, k));
      }
    }
  }
  for (int k = 0; k < 3; ++k) {
    Eigen::SparseMatrix<double, Eigen::RowMajor> sums(count, count);  // the same pattern for every k
    sums.setFromTriplets(weighted[k].begin(), weighted[k].end());
    smoothed.first.assign(sums.outerIndexPtr(), sums.outerIndexPtr() + count + 1);
    smoothed.vertices.assign(sums.innerIndexPtr(), sums.innerIndexPtr() + sums.nonZeros());
    if (k == 0) smoothed.gradients.resize(sums.nonZeros(), 3);
    smoothed.gradients.col(k) = Eigen::Map<const Eigen::VectorXd>(sums.valuePtr(), sums.nonZeros());
  }
  for (Eigen::Index v = 0; v < count; ++v) {
    smoothed.gradients.middleRows(smoothed.first[v], smoothed.first[v + 1] - smoothed.first[v]) /=
        smoothed.volumes[v];
  }
  return smoothed;
}

}  // namespace softbody
