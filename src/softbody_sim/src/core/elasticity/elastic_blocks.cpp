#include "elasticity/elastic_blocks.h"

#include <Eigen/LU>
#include <Eigen/QR>
#include <algorithm>

#include "tets/tet_shape.h"

namespace softbody {
namespace {

/// U^-1 of edges = Q U, with a rotation Q and an upper triangular U with positive diagonal.
Eigen::Matrix3d inverseTriangle(const Eigen::Matrix3d& edges) {
  Eigen::Matrix3d U = Eigen::HouseholderQR<Eigen::Matrix3d>(edges).matrixQR().triangularView<Eigen::Upper>();
  for (int row = 0; row < 3; ++row) {
    if (U(row, row) < 0.0) U.row(row) = -U.row(row);
  }
  return U.inverse();
}

std::size_t blockCount(Eigen::Index tet_count) {
  constexpr Eigen::Index kLanes = TetBlock<float>::kLanes;
  return static_cast<std::size_t>((tet_count + kLanes - 1) / kLanes);
}

}  // namespace

template <typename T>
ElasticBlocks<T>::ElasticBlocks(const Points& rest_vertices, const CorotatedElasticity& elasticity, Simd simd)
    : blocks_(blockCount(elasticity.tets().rows())), kernel_(elasticityKernel<T>(simd)) {
  const auto count = static_cast<Eigen::Index>(blocks_.size());
  for (Eigen::Index i = 0; i < count * TetBlock<T>::kLanes; ++i) {
    // Neighbouring tets go into different blocks: sums into the same vertex would wait for each other. Unused
    // lanes hold the last tet without stiffness.
    const Eigen::Index t = std::min(i, elasticity.tets().rows() - 1);
    const Eigen::RowVector4i tet = elasticity.tets().row(t);
    const Eigen::Matrix3d inverse = inverseTriangle(edgesOf(rest_vertices, tet));
    TetBlock<T>& block = blocks_[static_cast<std::size_t>(i % count)];
    const Eigen::Index lane = i / count;
    for (int column = 0, k = 0; column < 3; ++column) {
      for (int row = 0; row <= column; ++row, ++k)
        block.inverse_edges[k][lane] = static_cast<T>(inverse(row, column));
    }
    for (int k = 0; k < 4; ++k) block.corners[k][lane] = 4 * tet[k];
    const double volume = i == t ? elasticity.volumes()[t] : 0.0;
    block.shear[lane] = static_cast<T>(2.0 * elasticity.tetLame(t).mu * volume);
    block.bulk[lane] = static_cast<T>(elasticity.tetLame(t).lambda * volume);
  }
  if (elasticity.smoothed().volumes.size() > 0) patches_.emplace(elasticity, rest_vertices.rows(), simd);
}

template class ElasticBlocks<float>;
template class ElasticBlocks<double>;

}  // namespace softbody
