#include "targets/knn_targets.h"

#include <algorithm>
#include <nanoflann.hpp>
#include <numeric>
#include <set>

#include "prediction/vertex_places.h"
#include "softbody_common/geometry/rigid_fit.h"
#include "softbody_common/geometry/surface_binding.h"

namespace softbody {
namespace {

constexpr int kRotationNeighbors = 24;            // features for a local rotation; averages over their noise
constexpr Eigen::Index kMinRotationFeatures = 4;  // one more than the three that determine a rotation

using KdTree = nanoflann::KDTreeEigenMatrixAdaptor<Points, 3>;

}  // namespace

std::vector<double> inverseDistanceWeights(const std::vector<double>& sorted_distances) {
  std::vector<double> weights(sorted_distances.size(), 0.0);
  if (weights.empty()) return weights;
  if (sorted_distances.front() <= 0.0) {
    weights.front() = 1.0;
    return weights;
  }
  for (std::size_t j = 0; j < weights.size(); ++j) {
    weights[j] = 1.0 / sorted_distances[j] - 1.0 / sorted_distances.back();
  }
  const double sum = std::accumulate(weights.begin(), weights.end(), 0.0);
  for (double& w : weights) w = sum > 0.0 ? w / sum : 1.0 / static_cast<double>(weights.size());
  return weights;
}

void KnnTargets::bind(const std::vector<MapFeature>& features, const TetTopology& volume,
                      const Points& vertices) {
  vertices_.clear();
  if (features.empty()) return;
  Points positions(static_cast<Eigen::Index>(features.size()), 3);
  for (std::size_t f = 0; f < features.size(); ++f)
    positions.row(static_cast<Eigen::Index>(f)) = features[f].reference;
  const KdTree tree(3, std::cref(positions));
  const std::vector<MaterialPoint> places = vertexPlaces(volume);
  const std::set<int> surface_vertices(volume.surface.data(), volume.surface.data() + volume.surface.size());
  const auto wanted = std::min(features.size(),
                               static_cast<std::size_t>(std::max(config_.max_neighbors, kRotationNeighbors)));
  for (int v : surface_vertices) {
    BoundVertex bound{places[v], vertices.row(v), {}, {}};
    std::vector<Eigen::Index> indices(wanted);
    std::vector<double> squared(wanted);
    tree.query(bound.reference.data(), wanted, indices.data(), squared.data());
    std::vector<double> distances;
    for (std::size_t n = 0; n < wanted; ++n) {
      bound.wider_ids.push_back(features[indices[n]].id);
      const double distance = std::sqrt(squared[n]);
      const bool near = distance <= config_.radius_m && static_cast<int>(n) < config_.max_neighbors;
      if (near) distances.push_back(distance);
    }
    const std::vector<double> weights = inverseDistanceWeights(distances);
    for (std::size_t n = 0; n < weights.size(); ++n)
      bound.neighbors.push_back({bound.wider_ids[n], weights[n]});
    if (!bound.neighbors.empty()) vertices_.push_back(bound);
  }
}

void KnnTargets::rebind(const TetTopology& before, const TetTopology& after) {
  std::vector<MaterialPoint> places;
  for (const BoundVertex& bound : vertices_) places.push_back(bound.place);
  const std::vector<MaterialPoint> moved = transferPlaces(places, before, after);
  for (std::size_t v = 0; v < vertices_.size(); ++v) vertices_[v].place = moved[v];
}

/// Rotation of the nearest features on the vertex's piece; the fallback if there are too few.
Eigen::Matrix3d KnnTargets::localRotation(const BoundVertex& vertex, const FeatureMotions& motions,
                                          std::uint32_t piece, const Eigen::Matrix3d& fallback) const {
  if (!config_.local_rotation) return fallback;
  Points from(static_cast<Eigen::Index>(vertex.wider_ids.size()), 3), to(from.rows(), 3);
  Eigen::Index n = 0;
  for (int id : vertex.wider_ids) {
    const auto motion = motions.find(id);
    if (motion == motions.end() || motion->second.piece != piece) continue;
    from.row(n) = motion->second.reference;
    to.row(n++) = motion->second.current;
  }
  return n >= kMinRotationFeatures ? fitRigid(from.topRows(n), to.topRows(n)).linear() : fallback;
}

/// Kang et al. 2022, eq. 4, with the offsets from features to the vertex rotated; nothing without a feature.
std::optional<Eigen::Vector3d> KnnTargets::measuredPosition(const BoundVertex& vertex,
                                                            const FeatureMotions& motions,
                                                            std::uint32_t piece,
                                                            const Eigen::Matrix3d& rotation) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  double weight_sum = 0.0;
  for (const Neighbor& neighbor : vertex.neighbors) {
    const auto motion = motions.find(neighbor.feature_id);
    if (motion == motions.end() || motion->second.piece != piece) continue;
    const FeatureMotion& m = motion->second;
    sum += neighbor.weight * (m.current + rotation * (vertex.reference - m.reference));
    weight_sum += neighbor.weight;
  }
  if (weight_sum <= 0.0) return std::nullopt;
  return sum / weight_sum;
}

std::vector<Association> KnnTargets::associations(const std::vector<MapFeature>& features,
                                                  const std::vector<FeatureMatch>& matches,
                                                  const PredictedSurface& surface,
                                                  const Eigen::Matrix3d& R_camera_fixed) const {
  FeatureMotions motions;
  for (const FeatureMatch& match : matches) {
    const MapFeature& feature = features[match.feature];
    if (match.inlier)
      motions[feature.id] = {match.association.piece, feature.reference, match.association.measured};
  }
  std::vector<Association> result;
  for (const BoundVertex& vertex : vertices_) {
    const std::uint32_t piece = surface.pieceOf(vertex.place);
    const Eigen::Matrix3d rotation = localRotation(vertex, motions, piece, R_camera_fixed);
    const std::optional<Eigen::Vector3d> measured = measuredPosition(vertex, motions, piece, rotation);
    if (!measured) continue;
    Association association;
    association.kind = TargetKind::kVertex;
    association.place = vertex.place;
    association.piece = piece;
    association.predicted = surface.position(vertex.place);
    association.measured = *measured;
    result.push_back(association);
  }
  return result;
}

}  // namespace softbody
