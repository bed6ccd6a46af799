#include "surface_mesh/hole_caps.h"

#include <boost/pending/disjoint_sets.hpp>
#include <map>
#include <utility>
#include <vector>

namespace softbody {
namespace {

/// Edges with one triangle, in that triangle's direction.
std::vector<std::pair<int, int>> openEdges(const Triangles& triangles) {
  std::map<std::pair<int, int>, std::vector<std::pair<int, int>>> uses;
  for (Eigen::Index f = 0; f < triangles.rows(); ++f) {
    for (int k = 0; k < 3; ++k) {
      const int a = triangles(f, k), b = triangles(f, (k + 1) % 3);
      uses[std::minmax(a, b)].emplace_back(a, b);
    }
  }
  std::vector<std::pair<int, int>> open;
  for (const auto& [edge, directed] : uses) {
    if (directed.size() == 1) open.push_back(directed.front());
  }
  return open;
}

}  // namespace

TriangleMesh withHolesCovered(const TriangleMesh& mesh) {
  const std::vector<std::pair<int, int>> open = openEdges(mesh.triangles);
  if (open.empty()) return mesh;
  const auto vertex_count = static_cast<std::size_t>(mesh.vertices.rows());
  boost::disjoint_sets_with_storage<> holes(vertex_count);
  for (std::size_t v = 0; v < vertex_count; ++v) holes.make_set(v);
  for (const auto& [a, b] : open) holes.union_set(static_cast<std::size_t>(a), static_cast<std::size_t>(b));

  std::map<std::size_t, std::vector<std::pair<int, int>>> rims;
  for (const auto& edge : open) rims[holes.find_set(static_cast<std::size_t>(edge.first))].push_back(edge);
  TriangleMesh covered = mesh;
  covered.vertices.conservativeResize(mesh.vertices.rows() + static_cast<Eigen::Index>(rims.size()), 3);
  covered.triangles.conservativeResize(mesh.triangles.rows() + static_cast<Eigen::Index>(open.size()), 3);
  Eigen::Index middle = mesh.vertices.rows(), face = mesh.triangles.rows();
  for (const auto& [hole, rim] : rims) {
    Eigen::RowVector3d sum = Eigen::RowVector3d::Zero();
    for (const auto& [a, b] : rim) {
      sum += mesh.vertices.row(a) + mesh.vertices.row(b);
      covered.triangles.row(face++) << b, a, static_cast<int>(middle);
    }
    covered.vertices.row(middle++) = sum / (2.0 * static_cast<double>(rim.size()));
  }
  return covered;
}

}  // namespace softbody
