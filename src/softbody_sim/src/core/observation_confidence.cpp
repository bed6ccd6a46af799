#include "core/observation_confidence.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <queue>
#include <set>
#include <utility>

#include "softbody_common/tet_geometry.h"

namespace softbody {

ObservationConfidence::ObservationConfidence(const Points& rest_vertices, const Tets& tets)
    : tets_(tets),
      neighbors_(static_cast<std::size_t>(rest_vertices.rows())),
      decay_length_(2.0 * meanEdgeLength(rest_vertices, tets)) {
  std::set<std::pair<int, int>> edges;
  for (Eigen::Index t = 0; t < tets.rows(); ++t) {
    for (int a = 0; a < 4; ++a) {
      for (int b = 0; b < 4; ++b) {
        if (a != b) edges.emplace(tets(t, a), tets(t, b));
      }
    }
  }
  for (const auto& [a, b] : edges) {
    neighbors_[a].push_back({b, (rest_vertices.row(a) - rest_vertices.row(b)).norm()});
  }
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
