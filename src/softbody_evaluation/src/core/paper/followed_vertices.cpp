#include "paper/followed_vertices.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <set>
#include <utility>

namespace softbody::evaluation {
namespace {

// N_k and delta_k [m] of the paper, whose unit of length is taken as the metre.
constexpr std::size_t kNeighbors = 10;
constexpr double kRadius_m = 0.01;

}  // namespace

std::vector<double> inverseDistanceWeights(const std::vector<double>& sorted_distances) {
  std::vector<double> weights(sorted_distances.size(), 0.0);
  if (weights.empty()) return weights;
  if (sorted_distances.front() <= 0.0) {
    weights.front() = 1.0;
    return weights;
  }
  for (std::size_t j = 0; j < weights.size(); ++j)
    weights[j] = 1.0 / sorted_distances[j] - 1.0 / sorted_distances.back();
  const double sum = std::accumulate(weights.begin(), weights.end(), 0.0);
  for (double& w : weights) w = sum > 0.0 ? w / sum : 1.0 / static_cast<double>(weights.size());
  return weights;
}

FollowedVertices::FollowedVertices(const std::vector<TrackedFeature>& features, const TetTopology& volume,
                                   const Points& vertices) {
  const std::set<int> surface(volume.surface.data(), volume.surface.data() + volume.surface.size());
  for (const int v : surface) {
    Vertex vertex{v, vertices.row(v), {}};
    std::vector<std::pair<double, int>> near;  // distance, id
    for (const TrackedFeature& feature : features) {
      const double distance = (feature.reference - vertex.reference).norm();
      if (distance <= kRadius_m) near.emplace_back(distance, feature.id);
    }
    std::sort(near.begin(), near.end());
    near.resize(std::min(near.size(), kNeighbors));
    std::vector<double> distances;
    for (const auto& [distance, id] : near) distances.push_back(distance);
    const std::vector<double> weights = inverseDistanceWeights(distances);
    for (std::size_t n = 0; n < near.size(); ++n) vertex.neighbors.push_back({near[n].second, weights[n]});
    if (!near.empty()) vertices_.push_back(std::move(vertex));
  }
}

std::vector<MovedVertex> FollowedVertices::moved(const std::vector<TrackedFeature>& found) const {
  std::map<int, Eigen::Vector3d> displacements;
  for (const TrackedFeature& feature : found)
    displacements[feature.id] = feature.position - feature.reference;
  std::vector<MovedVertex> result;
  for (const Vertex& vertex : vertices_) {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    double weights = 0.0;
    for (const Neighbor& neighbor : vertex.neighbors) {
      const auto displacement = displacements.find(neighbor.feature_id);
      if (displacement == displacements.end()) continue;
      sum += neighbor.weight * displacement->second;
      weights += neighbor.weight;
    }
    if (weights > 0.0) result.push_back({vertex.index, vertex.reference + sum / weights});
  }
  return result;
}

}  // namespace softbody::evaluation
