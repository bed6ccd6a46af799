#include "softbody_sim/interpolation/visual_surface.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

#include "softbody_common/geometry/tet_locator.h"
#include "softbody_sim/mean_value/mean_value_coordinates.h"

namespace softbody {
namespace {

std::vector<int> verticesOf(const Triangles& triangles) {
  std::vector<int> vertices(triangles.data(), triangles.data() + triangles.size());
  std::sort(vertices.begin(), vertices.end());
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
  return vertices;
}

/// The surface without the inner vertices of the volume, whose weights are all 0.
MeanValueCage compactCage(const TetTopology& volume, const std::vector<int>& surface_vertices) {
  Points vertices(static_cast<Eigen::Index>(surface_vertices.size()), 3);
  std::vector<int> numbers(static_cast<std::size_t>(volume.rest_vertices.rows()), -1);
  for (std::size_t k = 0; k < surface_vertices.size(); ++k) {
    numbers[surface_vertices[k]] = static_cast<int>(k);
    vertices.row(static_cast<Eigen::Index>(k)) = volume.rest_vertices.row(surface_vertices[k]);
  }
  return {vertices, volume.surface.unaryExpr([&numbers](int v) { return numbers[v]; })};
}

}  // namespace

VisualSurface::VisualSurface(MeshTopology visual, const TetTopology& volume)
    : visual_(std::move(visual)),
      binding_(volume, bindPoints(visual_.rest_vertices, volume.rest_vertices, volume.tets)),
      surface_vertices_(verticesOf(volume.surface)) {
  bindInside(volume);
}

VisualSurface::VisualSurface(MeshTopology visual, TetBinding binding)
    : visual_(std::move(visual)), binding_(std::move(binding)) {
  by_tet_.resize(static_cast<std::size_t>(visual_.rest_vertices.rows()));
  std::iota(by_tet_.begin(), by_tet_.end(), 0);
}

void VisualSurface::bindInside(const TetTopology& volume) {
  constexpr Eigen::Index kAtOnce = 1024;  // bounds the memory of weights in double precision
  const MeanValueCage cage = compactCage(volume, surface_vertices_);
  const Eigen::Index count = visual_.rest_vertices.rows();
  auto inside_weights = std::make_shared<TiledWeights>(static_cast<Eigen::Index>(surface_vertices_.size()));
  WeightRows weights;
  for (Eigen::Index first = 0; first < count; first += kAtOnce) {
    const Points points = visual_.rest_vertices.middleRows(first, std::min(kAtOnce, count - first));
    const std::vector<int> turns = cage.coordinates(points, &weights);
    for (Eigen::Index p = 0; p < points.rows(); ++p) {
      const bool is_inside = turns[static_cast<std::size_t>(p)] != 0;
      (is_inside ? inside_ : by_tet_).push_back(static_cast<int>(first + p));
      if (is_inside) inside_weights->append(weights.row(p));
    }
  }
  inside_weights_ = std::move(inside_weights);
}

void VisualSurface::setRevision(std::uint32_t revision) {
  visual_.revision = revision;
  binding_.setRevision(revision);
}

std::size_t VisualSurface::bytes() const {
  const auto coordinates =
      static_cast<std::size_t>(visual_.rest_vertices.size() + visual_.texture_coordinates.size());
  const std::size_t indices = static_cast<std::size_t>(visual_.triangles.size()) +
                              visual_.vertex_parents.size() + visual_.triangle_pieces.size() +
                              surface_vertices_.size() + inside_.size() + by_tet_.size();
  return coordinates * sizeof(double) + indices * sizeof(int) + visual_.cut.size() / 8 + binding_.bytes();
}

int VisualSurface::outsideCount() const {
  constexpr double kRounding =
      1e-5;  // over the height of a tet; above the error of single-precision coordinates
  return static_cast<int>(std::count_if(by_tet_.begin(), by_tet_.end(), [this](int v) {
    return binding_.places()[static_cast<std::size_t>(v)].barycentric.minCoeff() < -kRounding;
  }));
}

MeshState VisualSurface::apply(const MeshState& volume) const {
  const TetTopology& bound = binding_.volume();
  const auto vertex_count = static_cast<std::size_t>(bound.rest_vertices.rows());
  if (volume.revision != bound.revision || volume.vertices.rows() != bound.rest_vertices.rows() ||
      volume.confidence.size() != vertex_count ||
      (!volume.standard_deviation.empty() && volume.standard_deviation.size() != vertex_count)) {
    throw std::invalid_argument(fmt::format(
        "state of revision {} with {} vertices, {} confidences and {} standard deviations; the volume is at "
        "revision {} with {} vertices",
        volume.revision, volume.vertices.rows(), volume.confidence.size(), volume.standard_deviation.size(),
        bound.revision, vertex_count));
  }
  MeshState state;
  state.revision = visual_.revision;
  state.observed = volume.observed;
  state.vertices.resize(visual_.rest_vertices.rows(), 3);
  state.confidence.resize(static_cast<std::size_t>(visual_.rest_vertices.rows()));
  applyInside(volume, &state);
  binding_.apply(volume, by_tet_, &state);
  if (!volume.standard_deviation.empty()) state.standard_deviation = standardDeviations(volume);
  return state;
}

/// The errors of a tet's vertices are nearly the same error, so they are interpolated like positions.
std::vector<float> VisualSurface::standardDeviations(const MeshState& volume) const {
  const Tets& tets = binding_.volume().tets;
  std::vector<float> result;
  result.reserve(binding_.places().size());
  for (const MaterialPoint& place : binding_.places()) {
    double sum = 0.0;
    for (int k = 0; k < 4; ++k)
      sum += std::abs(place.barycentric[k]) *
             volume.standard_deviation[static_cast<std::size_t>(tets(place.tet, k))];
    result.push_back(static_cast<float>(sum));
  }
  return result;
}

void VisualSurface::applyInside(const MeshState& volume, MeshState* state) const {
  if (inside_.empty()) return;
  // Relative to the centre, single precision is exact enough wherever the body is.
  const Eigen::RowVector3d center = volume.vertices.colwise().mean();
  TiledWeights::Values values(inside_weights_->columns(), 4);
  for (std::size_t k = 0; k < surface_vertices_.size(); ++k) {
    const auto row = static_cast<Eigen::Index>(k);
    values.block<1, 3>(row, 0) = (volume.vertices.row(surface_vertices_[k]) - center).cast<float>();
    values(row, 3) = volume.confidence[surface_vertices_[k]];
  }
  TiledWeights::Products interpolated;
  inside_weights_->multiply(values, &interpolated);
  for (std::size_t k = 0; k < inside_.size(); ++k) {
    const auto row = static_cast<Eigen::Index>(k);
    state->vertices.row(inside_[k]) = interpolated.block<1, 3>(row, 0).cast<double>() + center;
    state->confidence[inside_[k]] = std::clamp(interpolated(row, 3), 0.0f, 1.0f);
  }
}

}  // namespace softbody
