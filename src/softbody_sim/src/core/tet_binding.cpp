#include "softbody_sim/tet_binding.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <optional>

#include "softbody_common/tet_geometry.h"

namespace softbody {
namespace {

Eigen::Matrix3d edgesOf(const Points& vertices, const Eigen::RowVector4i& tet) {
  Eigen::Matrix3d edges;
  for (int k = 0; k < 3; ++k) edges.col(k) = vertices.row(tet[k + 1]) - vertices.row(tet[0]);
  return edges;
}

}  // namespace

TetBinding::TetBinding(const TetTopology& volume, std::vector<MaterialPoint> places)
    : volume_(volume), places_(std::move(places)) {}

/// Per piece the integral of |F^T F - I|^2, but for a factor.
std::vector<double> TetBinding::squaredStrains(const Points& vertices) const {
  std::vector<double> strains;
  for (Eigen::Index t = 0; t < volume_.tets.rows(); ++t) {
    const std::size_t body = volume_.bodies[static_cast<std::size_t>(t)];
    if (body >= strains.size()) strains.resize(body + 1, 0.0);
    const Eigen::RowVector4i tet = volume_.tets.row(t);
    const Eigen::Matrix3d rest = edgesOf(volume_.rest_vertices, tet);
    const Eigen::Matrix3d F = edgesOf(vertices, tet) * rest.inverse();
    strains[body] += rest.determinant() * (F.transpose() * F - Eigen::Matrix3d::Identity()).squaredNorm();
  }
  return strains;
}

std::vector<double> TetBinding::correctionScales(const Points& vertices) const {
  std::vector<double> scales = squaredStrains(vertices);
  for (std::size_t b = 0; b < scales.size(); ++b) {
    scales[b] = scales[b] >= strains_[b] ? 1.0 : std::sqrt(scales[b] / strains_[b]);
  }
  return scales;
}

void TetBinding::meet(const Points& vertices, const Points& positions) {
  using Solver = Eigen::PartialPivLU<Eigen::Matrix3d>;
  strains_ = squaredStrains(vertices);
  corrections_.resize(places_.size());
  std::vector<std::optional<Solver>> solvers(static_cast<std::size_t>(volume_.tets.rows()));
  for (std::size_t p = 0; p < places_.size(); ++p) {
    std::optional<Solver>& solver = solvers[static_cast<std::size_t>(places_[p].tet)];
    if (!solver) solver.emplace(edgesOf(vertices, volume_.tets.row(places_[p].tet)));
    const Eigen::Vector3d missing = positions.row(static_cast<Eigen::Index>(p)).transpose() -
                                    positionOf(places_[p], vertices, volume_.tets);
    const Eigen::Vector3d weights = solver->solve(missing);
    corrections_[p] << -weights.sum(), weights;
  }
}

void TetBinding::apply(const MeshState& volume, const std::vector<int>& which, MeshState* state) const {
  std::vector<double> scales;
  if (!corrections_.empty()) scales = correctionScales(volume.vertices);
  for (const int p : which) {
    MaterialPoint place = places_[static_cast<std::size_t>(p)];
    float confidence = 0.0f;
    for (int c = 0; c < 4; ++c) {
      confidence += static_cast<float>(place.barycentric[c]) *
                    volume.confidence[static_cast<std::size_t>(volume_.tets(place.tet, c))];
    }
    if (!scales.empty()) {
      const std::size_t body = volume_.bodies[static_cast<std::size_t>(place.tet)];
      place.barycentric += scales[body] * corrections_[static_cast<std::size_t>(p)];
    }
    state->vertices.row(p) = positionOf(place, volume.vertices, volume_.tets);
    state->confidence[static_cast<std::size_t>(p)] = std::clamp(confidence, 0.0f, 1.0f);
  }
}

}  // namespace softbody
