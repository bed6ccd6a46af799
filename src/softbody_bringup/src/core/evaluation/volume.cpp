#include "softbody_bringup/evaluation/volume.h"

#include <Eigen/Dense>
#include <array>
#include <cmath>
#include <utility>

#include "softbody_common/tet_geometry.h"

namespace softbody::evaluation {
namespace {

/// Index of the first vertex at the same place, per vertex.
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
  for (const auto& [edge, uses] : balance) {
    if (uses != 0) return false;
  }
  return !balance.empty();
}

VolumeReport volumeDrift(const MeshTopology& topology, const std::vector<const MeshState*>& states) {
  VolumeReport report;
  report.closed = isClosed(topology.rest_vertices, topology.triangles);
  if (!report.closed) return report;
  report.rest_m3 = enclosedVolume(topology.rest_vertices, topology.triangles);
  for (const MeshState* state : states) {
    const double change = enclosedVolume(state->vertices, topology.triangles) / report.rest_m3 - 1.0;
    report.changes.push_back(change);
    report.mean_change += change / static_cast<double>(states.size());
    if (std::abs(change) > std::abs(report.largest_change)) report.largest_change = change;
  }
  return report;
}

}  // namespace softbody::evaluation
