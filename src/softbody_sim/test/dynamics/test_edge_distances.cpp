#include "dynamics/edge_distances.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <set>

#include "fixtures/test_meshes.h"

namespace softbody {
namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();

struct Edge {
  int a, b;
  double length;
};

std::vector<Edge> edgesOf(const TetTopology& topology) {
  std::set<std::pair<int, int>> pairs;
  for (const auto& tet : topology.tets.rowwise()) {
    for (int a = 0; a < 4; ++a) {
      for (int b = 0; b < 4; ++b) {
        if (tet[a] < tet[b]) pairs.emplace(tet[a], tet[b]);
      }
    }
  }
  std::vector<Edge> edges;
  for (const auto& [a, b] : pairs)
    edges.push_back({a, b, (topology.rest_vertices.row(a) - topology.rest_vertices.row(b)).norm()});
  return edges;
}

/// Bellman and Ford: every edge, until nothing becomes nearer.
std::vector<double> slowDistances(const std::vector<Edge>& edges, const std::vector<char>& sources) {
  std::vector<double> distances;
  for (const char source : sources) distances.push_back(source != 0 ? 0.0 : kInfinite);
  for (bool changed = true; changed;) {
    changed = false;
    for (const Edge& edge : edges) {
      for (const auto& [from, to] : {std::pair(edge.a, edge.b), std::pair(edge.b, edge.a)}) {
        if (distances[from] + edge.length >= distances[to]) continue;
        distances[to] = distances[from] + edge.length;
        changed = true;
      }
    }
  }
  return distances;
}

TEST(EdgeDistances, AreTheShortestPaths) {
  std::mt19937 random(5);
  TetTopology topology = testing::sponge();
  topology.rest_vertices += testing::randomPoints(topology.rest_vertices.rows(), 0.004, &random);
  const std::vector<Edge> edges = edgesOf(topology);
  EdgeDistances distances(topology.rest_vertices, topology.tets);
  std::vector<double> found;
  for (int count = 1; count <= 20; ++count) {
    std::vector<char> sources(static_cast<std::size_t>(topology.rest_vertices.rows()), 0);
    for (int i = 0; i < count; ++i) sources[random() % sources.size()] = 1;
    distances.fromNearest(sources, &found);
    const std::vector<double> expected = slowDistances(edges, sources);
    ASSERT_EQ(found.size(), expected.size());
    for (std::size_t v = 0; v < found.size(); ++v) EXPECT_NEAR(found[v], expected[v], 1e-12);
  }
}

TEST(EdgeDistances, AreInfiniteWithoutAPath) {
  const TetTopology both = testing::twoBoxes({2, 1, 1}, {0.1, 0.05, 0.05});
  const auto count = static_cast<std::size_t>(both.rest_vertices.rows());
  EdgeDistances distances(both.rest_vertices, both.tets);
  std::vector<char> sources(count, 0);
  std::vector<double> found;
  distances.fromNearest(sources, &found);
  for (const double distance : found) EXPECT_EQ(distance, kInfinite);
  sources[0] = 1;
  distances.fromNearest(sources, &found);
  for (std::size_t v = 0; v < count; ++v) EXPECT_EQ(std::isfinite(found[v]), v < count / 2);
}

TEST(EdgeDistances, CountEachEdgeOnceInTheMean) {
  const TetTopology topology = testing::sponge();
  const std::vector<Edge> edges = edgesOf(topology);
  double sum = 0.0;
  for (const Edge& edge : edges) sum += edge.length;
  EXPECT_NEAR(EdgeDistances(topology.rest_vertices, topology.tets).meanLength(),
              sum / static_cast<double>(edges.size()), 1e-12);
}

}  // namespace
}  // namespace softbody
