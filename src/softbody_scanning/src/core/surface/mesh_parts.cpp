#include "softbody_scanning/surface/mesh_parts.h"

#include <map>
#include <numeric>

namespace softbody::scanning {
namespace {

int rootOf(int vertex, std::vector<int>* parents) {
  while ((*parents)[vertex] != vertex) vertex = (*parents)[vertex] = (*parents)[(*parents)[vertex]];
  return vertex;
}

TriangleMesh partOf(const TriangleMesh& mesh, const std::vector<Eigen::Index>& triangles) {
  std::map<int, int> renamed;
  TriangleMesh part;
  part.triangles.resize(static_cast<Eigen::Index>(triangles.size()), 3);
  for (std::size_t t = 0; t < triangles.size(); ++t)
    for (int corner = 0; corner < 3; ++corner)
      part.triangles(static_cast<Eigen::Index>(t), corner) =
          renamed.emplace(mesh.triangles(triangles[t], corner), static_cast<int>(renamed.size()))
              .first->second;
  part.vertices.resize(static_cast<Eigen::Index>(renamed.size()), 3);
  for (const auto& [before, now] : renamed) part.vertices.row(now) = mesh.vertices.row(before);
  return part;
}

}  // namespace

std::vector<TriangleMesh> partsOf(const TriangleMesh& mesh) {
  std::vector<int> parents(static_cast<std::size_t>(mesh.vertices.rows()));
  std::iota(parents.begin(), parents.end(), 0);
  for (const auto& t : mesh.triangles.rowwise())
    for (int corner = 1; corner < 3; ++corner) parents[rootOf(t[corner], &parents)] = rootOf(t[0], &parents);
  std::map<int, std::vector<Eigen::Index>> triangles;
  for (Eigen::Index t = 0; t < mesh.triangles.rows(); ++t)
    triangles[rootOf(mesh.triangles(t, 0), &parents)].push_back(t);
  std::vector<TriangleMesh> parts;
  for (const auto& [root, members] : triangles) parts.push_back(partOf(mesh, members));
  return parts;
}

}  // namespace softbody::scanning
