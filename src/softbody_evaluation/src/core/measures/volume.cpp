#include "softbody_evaluation/measures/volume.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <set>
#include <utility>

#include "softbody_common/geometry/tet_geometry.h"

namespace softbody::evaluation {
namespace {

/// Per vertex, the index of the first vertex at the same position.
std::vector<int> places(const Points& vertices) {
  std::map<std::array<double, 3>, int> first;
  std::vector<int> place;
  for (Eigen::Index i = 0; i < vertices.rows(); ++i) {
    const std::array<double, 3> key = {vertices(i, 0), vertices(i, 1), vertices(i, 2)};
    place.push_back(first.emplace(key, static_cast<int>(i)).first->second);
  }
  return place;
}

}  // namespace

bool isClosed(const Points& vertices, const Triangles& triangles) {
  const std::vector<int> place = places(vertices);
  std::map<std::pair<int, int>, int> balance;  // uses of an edge (low, high): forth minus back
  for (Eigen::Index f = 0; f < triangles.rows(); ++f) {
    for (int k = 0; k < 3; ++k) {
      const int a = place[static_cast<std::size_t>(triangles(f, k))];
      const int b = place[static_cast<std::size_t>(triangles(f, (k + 1) % 3))];
      if (a != b) balance[std::minmax(a, b)] += a < b ? 1 : -1;
    }
  }
  return !balance.empty() &&
         std::all_of(balance.begin(), balance.end(), [](const auto& edge) { return edge.second == 0; });
}

Change changeOf(const std::vector<double>& values) {
  const double sum = std::accumulate(values.begin(), values.end(), 0.0);
  const auto smaller = [](double a, double b) { return std::abs(a) < std::abs(b); };
  return {sum / static_cast<double>(values.size()), *std::max_element(values.begin(), values.end(), smaller)};
}

VolumeReport volumeDrift(const std::map<std::uint32_t, MeshTopology>& topologies,
                         const std::vector<const MeshState*>& states) {
  VolumeReport report;
  if (topologies.empty() || states.empty()) return report;
  const MeshTopology& loaded = topologies.begin()->second;
  std::set<std::uint32_t> revisions{topologies.begin()->first};
  for (const MeshState* state : states) revisions.insert(state->revision);
  report.closed = std::all_of(revisions.begin(), revisions.end(), [&](std::uint32_t revision) {
    return isClosed(topologies.at(revision).rest_vertices, topologies.at(revision).triangles);
  });
  if (!report.closed) return report;
  report.rest_m3 = enclosedVolume(loaded.rest_vertices, loaded.triangles);
  std::vector<double> of_revisions, of_frames;
  for (const std::uint32_t revision : revisions) {
    const MeshTopology& topology = topologies.at(revision);
    of_revisions.push_back(enclosedVolume(topology.rest_vertices, topology.triangles) / report.rest_m3 - 1.0);
  }
  for (const MeshState* state : states) {
    report.volumes.push_back(enclosedVolume(state->vertices, topologies.at(state->revision).triangles));
    of_frames.push_back(report.volumes.back() / report.rest_m3 - 1.0);
  }
  report.cut_change = changeOf(of_revisions).largest;
  report.change = changeOf(of_frames);
  return report;
}

}  // namespace softbody::evaluation
