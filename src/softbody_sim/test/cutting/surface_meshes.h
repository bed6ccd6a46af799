#pragma once

#include <cmath>
#include <map>
#include <string>

#include "core/cutting/half_edges.h"
#include "core/surface_repair.h"

namespace softbody::testing {

inline MeshTopology meshTopology(const TriangleMesh& surface, const Points& texture_coordinates = Points()) {
  MeshTopology mesh;
  mesh.rest_vertices = surface.vertices;
  mesh.triangles = surface.triangles;
  for (int v = 0; v < surface.vertices.rows(); ++v) mesh.vertex_parents.push_back(v);
  mesh.bodies.assign(static_cast<std::size_t>(surface.triangles.rows()), 0);
  mesh.cut.assign(static_cast<std::size_t>(surface.triangles.rows()), false);
  mesh.texture_coordinates = texture_coordinates;
  return mesh;
}

inline MeshTopology loadMesh(const std::string& path) {
  Warnings warnings;
  const WeldedSurface surface = loadSurface(path, 1.0, &warnings);
  return meshTopology(surface.mesh, surface.texture_coordinates);
}

/// A torus round the z axis, through every point of which the texture coordinates run linearly but for the
/// seams.
inline MeshTopology torus(int around = 48, int across = 24, double radius = 0.08, double thickness = 0.03) {
  TriangleMesh mesh{Points(around * across, 3), Triangles(2 * around * across, 3)};
  for (int i = 0; i < around; ++i) {
    for (int j = 0; j < across; ++j) {
      const double u = 2.0 * M_PI * i / around, v = 2.0 * M_PI * j / across;
      const double r = radius + thickness * std::cos(v);
      mesh.vertices.row(i * across + j) << r * std::cos(u), r * std::sin(u), thickness * std::sin(v);
      const int next_i = (i + 1) % around, next_j = (j + 1) % across;
      mesh.triangles.row(2 * (i * across + j)) << i * across + j, next_i * across + j,
          next_i * across + next_j;
      mesh.triangles.row(2 * (i * across + j) + 1) << i * across + j, next_i * across + next_j,
          i * across + next_j;
    }
  }
  return meshTopology(mesh);
}

/// Signed volume of each piece [m^3].
inline std::map<std::uint32_t, double> bodyVolumes(const MeshTopology& mesh) {
  std::map<std::uint32_t, double> volumes;
  for (Eigen::Index t = 0; t < mesh.triangles.rows(); ++t) {
    const Eigen::Vector3d a = mesh.rest_vertices.row(mesh.triangles(t, 0));
    const Eigen::Vector3d b = mesh.rest_vertices.row(mesh.triangles(t, 1));
    const Eigen::Vector3d c = mesh.rest_vertices.row(mesh.triangles(t, 2));
    volumes[mesh.bodies[static_cast<std::size_t>(t)]] += a.dot(b.cross(c)) / 6.0;
  }
  return volumes;
}

inline double volumeOf(const MeshTopology& mesh) {
  double sum = 0.0;
  for (const auto& [body, volume] : bodyVolumes(mesh)) sum += volume;
  return sum;
}

/// What keeps a mesh from being closed and 2-manifold, of pieces with a positive volume that add up to the
/// given one; empty if nothing does.
inline std::string faultOf(const MeshTopology& mesh, double volume) {
  const TriangleList triangles = listOf(mesh.triangles);
  const auto vertex_count = static_cast<std::size_t>(mesh.rest_vertices.rows());
  std::vector<int> mates;
  try {
    mates = halfEdgeMates(triangles, static_cast<int>(vertex_count));
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  std::vector<int> corners(vertex_count, 0), first(vertex_count, -1);
  for (int h = 0; h < static_cast<int>(mates.size()); ++h) {
    ++corners[static_cast<std::size_t>(startOf(triangles, h))];
    first[static_cast<std::size_t>(startOf(triangles, h))] = h;
    if (mesh.bodies[static_cast<std::size_t>(h) / 3] != mesh.bodies[static_cast<std::size_t>(mates[h]) / 3]) {
      return "neighbours are numbered as different pieces";
    }
  }
  for (std::size_t v = 0; v < vertex_count; ++v) {
    if (corners[v] == 0) return "a vertex belongs to no triangle";
    int round = 0, h = first[v];
    do {
      ++round;
      h = mates[previousHalfEdge(h)];
    } while (h != first[v]);
    if (round != corners[v]) return "two fans of triangles meet in one vertex";
  }
  if (std::abs(volumeOf(mesh) - volume) > 1e-3 * volume) return "the volume has changed";
  for (const auto& [body, part] : bodyVolumes(mesh)) {
    if (part <= 0.0) return "a piece has no volume";
  }
  return "";
}

}  // namespace softbody::testing
