#include "tets/tet_values.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

namespace softbody {
namespace {

constexpr double kSmallestVolume_m3 = 1e-18;

Eigen::Matrix3d edgesOf(const Points& vertices, const Eigen::Vector4i& tet) {
  Eigen::Matrix3d edges;
  for (int k = 0; k < 3; ++k) edges.col(k) = (vertices.row(tet[k + 1]) - vertices.row(tet[0])).transpose();
  return edges;
}

double largestStrain(const Eigen::Matrix3d& gradient) {
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver;
  solver.computeDirect(gradient.transpose() * gradient, Eigen::EigenvaluesOnly);
  const Eigen::Array3d stretches = solver.eigenvalues().cwiseMax(0.0).cwiseSqrt().array();
  return (stretches - 1.0).abs().maxCoeff();
}

}  // namespace

std::vector<float> tetQualities(const Points& vertices, const Tets& tets) {
  std::vector<float> qualities(static_cast<std::size_t>(tets.rows()));
  for (std::size_t t = 0; t < qualities.size(); ++t) {
    const Eigen::Vector4i tet = tets.row(static_cast<Eigen::Index>(t));
    const Eigen::Matrix3d edges = edgesOf(vertices, tet);
    const double squares = edges.squaredNorm() + (edges.col(0) - edges.col(1)).squaredNorm() +
                           (edges.col(1) - edges.col(2)).squaredNorm() +
                           (edges.col(2) - edges.col(0)).squaredNorm();
    const double volume = std::max(0.0, edges.determinant() / 6.0);
    qualities[t] =
        squares > 0.0 ? static_cast<float>(12.0 * std::pow(3.0 * volume, 2.0 / 3.0) / squares) : 0.0f;
  }
  return qualities;
}

TetStrain::TetStrain(const TetTopology& topology) : tets_(topology.tets) {
  for (Eigen::Index t = 0; t < tets_.rows(); ++t) {
    const Eigen::Matrix3d rest = edgesOf(topology.rest_vertices, tets_.row(t));
    const bool flat = std::abs(rest.determinant()) < 6.0 * kSmallestVolume_m3;
    inverse_rest_.push_back(flat ? Eigen::Matrix3d::Zero().eval() : rest.inverse().eval());
  }
}

std::vector<float> TetStrain::at(const Points& vertices) const {
  std::vector<float> strains(inverse_rest_.size(), 0.0f);
  for (std::size_t t = 0; t < strains.size(); ++t) {
    if (inverse_rest_[t].isZero(0.0)) continue;
    const Eigen::Vector4i tet = tets_.row(static_cast<Eigen::Index>(t));
    strains[t] = static_cast<float>(largestStrain(edgesOf(vertices, tet) * inverse_rest_[t]));
  }
  return strains;
}

}  // namespace softbody
