#include "core/observation_confidence.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <queue>
#include <utility>

namespace softbody {
namespace {

/// Each once, from its lower vertex, ascending.
std::vector<std::pair<int, int>> edgesOf(const Tets& tets) {
  std::vector<std::pair<int, int>> edges;
  edges.reserve(static_cast<std::size_t>(6 * tets.rows()));
  for (Eigen::Index t = 0; t < tets.rows(); ++t) {
    for (int a = 0; a < 4; ++a) {
      for (int b = a + 1; b < 4; ++b) edges.push_back(std::minmax(tets(t, a), tets(t, b)));
    }
  }
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  return edges;
}

}  // namespace

ObservationConfidence::ObservationConfidence(const Points& rest_vertices, const Tets& tets)
    : tets_(tets), neighbors_(static_cast<std::size_t>(rest_vertices.rows())) {
  double sum = 0.0;
  int count = 0;
  for (const auto& [a, b] : edgesOf(tets)) {
    const double length = (rest_vertices.row(a) - rest_vertices.row(b)).norm();
    neighbors_[a].push_back({b, length});
    neighbors_[b].push_back({a, length});
    sum += length;
    ++count;
  }
  decay_length_ = count > 0 ? 2.0 * sum / count : 0.0;
}

std::vector<float> ObservationConfidence::of(const std::vector<Target>& targets) const {
  constexpr double kObserved = 0.25;
  std::vector<double> support(neighbors_.size(), 0.0);
  for (const Target& target : targets) {
    for (int k = 0; k < 4; ++k) {
      support[tets_(target.place.tet, k)] += target.weight * std::max(0.0, target.place.barycentric[k]);
    }
  }
  // Dijkstra from all observed vertices at once.
  using Entry = std::pair<double, int>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<Entry>> queue;
  std::vector<double> distance(neighbors_.size(), std::numeric_limits<double>::infinity());
  for (std::size_t v = 0; v < support.size(); ++v) {
    if (support[v] >= kObserved) queue.emplace(distance[v] = 0.0, static_cast<int>(v));
  }
  while (!queue.empty()) {
    const auto [reached, vertex] = queue.top();
    queue.pop();
    if (reached > distance[vertex]) continue;
    for (const Neighbor& neighbor : neighbors_[vertex]) {
      const double candidate = reached + neighbor.distance;
      if (candidate < distance[neighbor.vertex])
        queue.emplace(distance[neighbor.vertex] = candidate, neighbor.vertex);
    }
  }
  std::vector<float> confidence(distance.size());
  for (std::size_t v = 0; v < distance.size(); ++v)
    confidence[v] = static_cast<float>(std::exp(-distance[v] / decay_length_));
  return confidence;
}

}  // namespace softbody
