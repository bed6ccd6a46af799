#include "dynamics/edge_distances.h"

#include <algorithm>
#include <functional>
#include <limits>
#include <utility>

namespace softbody {
namespace {

/// Each edge once, lower vertex first, sorted.
std::vector<std::pair<int, int>> uniqueEdges(const Tets& tets) {
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

EdgeDistances::EdgeDistances(const Points& rest_vertices, const Tets& tets)
    : neighbors_(static_cast<std::size_t>(rest_vertices.rows())) {
  const std::vector<std::pair<int, int>> edges = uniqueEdges(tets);
  for (const auto& [a, b] : edges) {
    const double length = (rest_vertices.row(a) - rest_vertices.row(b)).norm();
    neighbors_[a].push_back({b, length});
    neighbors_[b].push_back({a, length});
    mean_length_ += length / static_cast<double>(edges.size());
  }
  queue_.reserve(neighbors_.size() + 2 * edges.size());  // each edge is pushed once from each end
}

void EdgeDistances::fromNearest(const std::vector<char>& sources, std::vector<double>* distances) {
  const auto push = [this, distances](double distance, int vertex) {
    queue_.emplace_back((*distances)[vertex] = distance, vertex);
    std::push_heap(queue_.begin(), queue_.end(), std::greater<>());
  };
  distances->assign(neighbors_.size(), std::numeric_limits<double>::infinity());
  for (std::size_t v = 0; v < sources.size(); ++v) {
    if (sources[v] != 0) push(0.0, static_cast<int>(v));
  }
  while (!queue_.empty()) {
    const auto [reached, vertex] = queue_.front();
    std::pop_heap(queue_.begin(), queue_.end(), std::greater<>());
    queue_.pop_back();
    if (reached > (*distances)[vertex]) continue;
    for (const Neighbor& neighbor : neighbors_[vertex]) {
      const double candidate = reached + neighbor.distance;
      if (candidate < (*distances)[neighbor.vertex]) push(candidate, neighbor.vertex);
    }
  }
}

}  // namespace softbody
