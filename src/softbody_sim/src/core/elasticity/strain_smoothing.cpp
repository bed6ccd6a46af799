#include "elasticity/strain_smoothing.h"

#include <algorithm>

#include <Eigen/LU>
#include <Eigen/SparseCore>
#include <array>

#include "softbody_common/geometry/tet_geometry.h"
#include "tets/tet_shape.h"

namespace softbody {
namespace {

/// Numbers the patches in the order of their vertices, and then of their materials' kinds.
/// @return #kinds by #V, -1 where no tet of the kind is. @param kinds of the patches.
Eigen::MatrixXi numberPatches(Eigen::Index vertex_count, const Tets& tets, const ElasticMaterials& materials,
                              std::vector<int>* kinds) {
  Eigen::MatrixXi numbers =
      Eigen::MatrixXi::Constant(static_cast<Eigen::Index>(materials.kinds.size()), vertex_count, -1);
  for (Eigen::Index t = 0; t < tets.rows(); ++t) {
    for (int a = 0; a < 4; ++a) numbers(materials.kindOf(t), tets(t, a)) = 0;
  }
  for (Eigen::Index v = 0; v < vertex_count; ++v) {
    for (Eigen::Index kind = 0; kind < numbers.rows(); ++kind) {
      if (numbers(kind, v) < 0) continue;
      numbers(kind, v) = static_cast<int>(kinds->size());
      kinds->push_back(static_cast<int>(kind));
    }
  }
  return numbers;
}

}  // namespace

double volumeSmoothing(double poisson_ratio) {
  constexpr double kUnsmoothed = 0.3, kHarmless = 0.2;  // as of shear; Poisson's ratio that does not lock
  const auto ratio = [](double nu) { return 2.0 * nu / (1.0 - 2.0 * nu); };  // lambda / mu
  const double softer = (1.0 - 2.0 * poisson_ratio) / (1.0 - 2.0 * kHarmless);
  return 1.0 - kUnsmoothed * std::min(1.0, softer * ratio(kHarmless) / ratio(poisson_ratio));
}

Lame tetPart(const ElasticMaterial& m) {
  return {m.lame.mu * (1.0 - m.smoothing.strain), m.lame.lambda * (1.0 - m.smoothing.volume)};
}

Lame patchPart(const ElasticMaterial& m) {
  return {m.lame.mu * m.smoothing.strain, m.lame.lambda * m.smoothing.volume};
}

bool hasPatches(const ElasticMaterials& materials) {
  return std::any_of(materials.kinds.begin(), materials.kinds.end(), [](const ElasticMaterial& material) {
    const Lame part = patchPart(material);
    return part.mu + part.lambda > 0.0;
  });
}

SmoothedGradients smoothedGradients(const Points& rest_vertices, const Tets& tets,
                                    const ElasticMaterials& materials) {
  const Eigen::VectorXd tet_volumes = tetVolumes(rest_vertices, tets);
  SmoothedGradients smoothed;
  const Eigen::MatrixXi patches = numberPatches(rest_vertices.rows(), tets, materials, &smoothed.kinds);
  const auto count = static_cast<Eigen::Index>(smoothed.kinds.size());
  smoothed.volumes.setZero(count);
  std::array<std::vector<Eigen::Triplet<double>>, 3> weighted;  // row p: gradients times volumes
  for (Eigen::Index t = 0; t < tets.rows(); ++t) {
    const double share = 0.25 * tet_volumes[t];
    const Eigen::Matrix<double, 4, 3> gradients =
        share * shapeGradients(edgesOf(rest_vertices, tets.row(t)).inverse());
    for (int a = 0; a < 4; ++a) {
      const int patch = patches(materials.kindOf(t), tets(t, a));
      smoothed.volumes[patch] += share;
      for (int b = 0; b < 4; ++b) {
        for (int k = 0; k < 3; ++k) weighted[k].emplace_back(patch, tets(t, b), gradients(b, k));
      }
    }
  }
  for (int k = 0; k < 3; ++k) {
    Eigen::SparseMatrix<double, Eigen::RowMajor> sums(count, rest_vertices.rows());  // one pattern for all k
    sums.setFromTriplets(weighted[k].begin(), weighted[k].end());
    smoothed.first.assign(sums.outerIndexPtr(), sums.outerIndexPtr() + count + 1);
    smoothed.vertices.assign(sums.innerIndexPtr(), sums.innerIndexPtr() + sums.nonZeros());
    if (k == 0) smoothed.gradients.resize(sums.nonZeros(), 3);
    smoothed.gradients.col(k) = Eigen::Map<const Eigen::VectorXd>(sums.valuePtr(), sums.nonZeros());
  }
  for (Eigen::Index p = 0; p < count; ++p) {
    smoothed.gradients.middleRows(smoothed.first[p], smoothed.first[p + 1] - smoothed.first[p]) /=
        smoothed.volumes[p];
  }
  return smoothed;
}

}  // namespace softbody
