#include "shells/shell_nesting.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "shells/connected_groups.h"
#include "shells/shell_union.h"
#include "shells/surface_transfer.h"

namespace softbody {
namespace {

using Pairs = std::vector<std::pair<std::size_t, std::size_t>>;

TriangleMesh meshOf(const TriangleMesh& mesh, const Shell& shell) {
  WeldedSurface part{mesh, {}, std::vector<int>(static_cast<std::size_t>(mesh.vertices.rows()), -1)};
  keepTriangles(shell.triangles, &part);
  return part.mesh;
}

std::vector<TriangleMesh> meshesOf(const TriangleMesh& mesh, const std::vector<Shell>& shells) {
  std::vector<TriangleMesh> meshes;
  for (const Shell& shell : shells) meshes.push_back(meshOf(mesh, shell));
  return meshes;
}

/// The exact test is only needed where boxes overlap.
Pairs crossings(const std::vector<Shell>& shells, const std::vector<TriangleMesh>& meshes) {
  for (std::size_t i = 0; i < shells.size(); ++i)
    for (std::size_t k = 0; k < i; ++k)
      if (shells[i].box.intersects(shells[k].box)) return crossingPairs(meshes);
  return {};
}

/// Unites the smallest two again and again, so that a large mesh is not worked on for each small one. What
/// cannot be united stays as it is.
std::vector<TriangleMesh> united(std::vector<TriangleMesh> parts) {
  const auto larger = [](const TriangleMesh& a, const TriangleMesh& b) {
    return a.triangles.rows() > b.triangles.rows();
  };
  std::vector<TriangleMesh> left_alone;
  while (parts.size() > 1) {
    std::stable_sort(parts.begin(), parts.end(), larger);
    const TriangleMesh smallest = std::move(parts.back());
    parts.pop_back();
    if (std::optional<TriangleMesh> both = unionOf(parts.back(), smallest)) {
      parts.back() = std::move(*both);
    } else {
      left_alone.push_back(smallest);
    }
  }
  left_alone.push_back(std::move(parts.front()));
  return left_alone;
}

TriangleMesh joined(const std::vector<TriangleMesh>& meshes) {
  Eigen::Index vertices = 0, triangles = 0;
  for (const TriangleMesh& mesh : meshes)
    vertices += mesh.vertices.rows(), triangles += mesh.triangles.rows();
  TriangleMesh all{Points(vertices, 3), Triangles(triangles, 3)};
  vertices = triangles = 0;
  for (const TriangleMesh& mesh : meshes) {
    all.vertices.middleRows(vertices, mesh.vertices.rows()) = mesh.vertices;
    all.triangles.middleRows(triangles, mesh.triangles.rows()) =
        mesh.triangles.array() + static_cast<int>(vertices);
    vertices += mesh.vertices.rows(), triangles += mesh.triangles.rows();
  }
  return all;
}

/// Rounding splits some of the new vertices.
WeldedSurface cleaned(const WeldedSurface& surface) {
  Warnings unimportant;
  WeldedSurface result = repairSurface({surface.mesh, surface.texture_coordinates}, "", &unimportant);
  for (int& parent : result.vertex_parents) parent = surface.vertex_parents[static_cast<std::size_t>(parent)];
  return result;
}

}  // namespace

std::ptrdiff_t orientShells(WeldedSurface* surface) {
  const std::vector<Shell> shells = shellsOf(surface->mesh);
  const std::vector<std::vector<std::size_t>> containers = containersOf(surface->mesh, shells);
  std::vector<bool> flip(static_cast<std::size_t>(surface->mesh.triangles.rows()), false);
  for (std::size_t s = 0; s < shells.size(); ++s) {
    if (shells[s].isSheet()) continue;
    const bool is_cavity = containers[s].size() % 2 == 1;
    if ((shells[s].volume < 0.0) == is_cavity) continue;
    for (const Eigen::Index f : shells[s].triangles) flip[static_cast<std::size_t>(f)] = true;
  }
  return flipTriangles(flip, surface);
}

int uniteShells(WeldedSurface* surface) {
  const std::vector<Shell> shells = shellsOf(surface->mesh);
  const std::vector<TriangleMesh> meshes = meshesOf(surface->mesh, shells);
  std::vector<TriangleMesh> results;
  int count = 0;
  for (const std::vector<std::size_t>& group : connectedGroups(shells.size(), crossings(shells, meshes))) {
    std::vector<TriangleMesh> parts;
    for (const std::size_t s : group) parts.push_back(meshes[s]);
    std::vector<TriangleMesh> whole = united(std::move(parts));
    if (whole.size() < group.size()) count += static_cast<int>(group.size() - whole.size() + 1);
    results.insert(results.end(), whole.begin(), whole.end());
  }
  if (count > 0) *surface = cleaned(transferred(*surface, joined(results)));
  return count;
}

std::vector<Body> bodiesOf(const TriangleMesh& mesh) {
  const std::vector<Shell> shells = shellsOf(mesh);
  Pairs pairs = crossings(shells, meshesOf(mesh, shells));
  const std::vector<std::vector<std::size_t>> containers = containersOf(mesh, shells);
  for (std::size_t s = 0; s < shells.size(); ++s)
    for (const std::size_t outer : containers[s]) pairs.emplace_back(s, outer);
  std::vector<Body> bodies;
  for (const std::vector<std::size_t>& group : connectedGroups(shells.size(), pairs)) {
    Body body;
    for (const std::size_t s : group) {
      body.triangles.insert(body.triangles.end(), shells[s].triangles.begin(), shells[s].triangles.end());
      body.box.extend(shells[s].box);
      body.volume += shells[s].volume;
    }
    std::sort(body.triangles.begin(), body.triangles.end());
    bodies.push_back(std::move(body));
  }
  std::stable_sort(bodies.begin(), bodies.end(),
                   [](const Body& a, const Body& b) { return a.volume > b.volume; });
  return bodies;
}

}  // namespace softbody
