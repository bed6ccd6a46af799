#include "dynamics/vertex_confidence.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <utility>

namespace softbody {
namespace {

/// Each edge once, lower vertex first, sorted.
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

VertexConfidence::VertexConfidence(const Points& rest_vertices, const Tets& tets)
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
  support_.reserve(neighbors_.size());
  distance_.reserve(neighbors_.size());
  queue_.reserve(neighbors_.size() +
                 2 * static_cast<std::size_t>(count));  // each edge is pushed once from each end
}

/// Dijkstra's algorithm from all observed vertices.
void VertexConfidence::findDistances() {
  constexpr double kObserved = 0.25;
  const auto push = [this](double distance, int vertex) {
    queue_.emplace_back(distance_[vertex] = distance, vertex);
    std::push_heap(queue_.begin(), queue_.end(), std::greater<>());
  };
  distance_.assign(neighbors_.size(), std::numeric_limits<double>::infinity());
  for (std::size_t v = 0; v < support_.size(); ++v) {
    if (support_[v] >= kObserved) push(0.0, static_cast<int>(v));
  }
  while (!queue_.empty()) {
    const auto [reached, vertex] = queue_.front();
    std::pop_heap(queue_.begin(), queue_.end(), std::greater<>());
    queue_.pop_back();
    if (reached > distance_[vertex]) continue;
    for (const Neighbor& neighbor : neighbors_[vertex]) {
      const double candidate = reached + neighbor.distance;
      if (candidate < distance_[neighbor.vertex]) push(candidate, neighbor.vertex);
    }
  }
}

void VertexConfidence::compute(const std::vector<Target>& targets, std::vector<float>* confidence) {
  support_.assign(neighbors_.size(), 0.0);
  for (const Target& target : targets) {
    for (int k = 0; k < 4; ++k) {
      support_[tets_(target.place.tet, k)] += target.weight * std::max(0.0, target.place.barycentric[k]);
    }
  }
  findDistances();
  confidence->resize(distance_.size());
  for (std::size_t v = 0; v < distance_.size(); ++v)
    (*confidence)[v] = static_cast<float>(std::exp(-distance_[v] / decay_length_));
}

}  // namespace softbody
