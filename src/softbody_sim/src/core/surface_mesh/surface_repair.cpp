#include "surface_mesh/surface_repair.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <stdexcept>

#include "surface_mesh/orientation.h"
#include "surface_mesh/weld.h"

namespace softbody {
namespace {

constexpr double kWeldShare = 1e-7;  ///< of the mesh's size
constexpr double kFlatShare = 1e-9;  ///< height of a triangle over its longest edge

void weld(WeldedSurface* surface, const std::string& name, Warnings* warnings) {
  Points& vertices = surface->mesh.vertices;
  const std::vector<int> first = firstCoincident(vertices, kWeldShare * std::max(sizeOf(vertices), 1e-300));
  std::vector<int> index(first.size());
  for (std::size_t v = 0; v < first.size(); ++v) {
    const bool stays = first[v] == static_cast<int>(v);
    index[v] =
        stays ? static_cast<int>(surface->vertex_parents.size()) : index[static_cast<std::size_t>(first[v])];
    if (stays) surface->vertex_parents.push_back(static_cast<int>(v));
  }
  const std::size_t welded = first.size() - surface->vertex_parents.size();
  vertices = Points(vertices(surface->vertex_parents, Eigen::all));
  for (int& vertex : surface->mesh.triangles.reshaped()) vertex = index[static_cast<std::size_t>(vertex)];
  if (welded > 0) warnings->push_back(fmt::format("{}: {} coincident vertices were welded", name, welded));
}

bool isFlat(const Points& vertices, const Eigen::RowVector3i& t) {
  const Eigen::Vector3d a = vertices.row(t[0]), b = vertices.row(t[1]), c = vertices.row(t[2]);
  const double longest = std::max({(b - a).squaredNorm(), (c - b).squaredNorm(), (a - c).squaredNorm()});
  return !((b - a).cross(c - a).norm() > kFlatShare * longest);
}

void keepTriangles(WeldedSurface* surface, const std::vector<Eigen::Index>& kept) {
  const bool textured = surface->texture_coordinates.rows() > 0;
  std::vector<Eigen::Index> corners;
  for (const Eigen::Index f : kept) corners.insert(corners.end(), {3 * f, 3 * f + 1, 3 * f + 2});
  surface->mesh.triangles = Triangles(surface->mesh.triangles(kept, Eigen::all));
  if (textured) surface->texture_coordinates = Points(surface->texture_coordinates(corners, Eigen::all));
}

void dropUseless(WeldedSurface* surface, const std::string& name, Warnings* warnings) {
  std::vector<Eigen::Index> kept;
  std::set<std::array<int, 3>> seen;
  int flat = 0, repeated = 0;
  for (Eigen::Index f = 0; f < surface->mesh.triangles.rows(); ++f) {
    const Eigen::RowVector3i triangle = surface->mesh.triangles.row(f);
    std::array<int, 3> corners{triangle[0], triangle[1], triangle[2]};
    std::sort(corners.begin(), corners.end());
    if (isFlat(surface->mesh.vertices, triangle)) {
      ++flat;
    } else if (!seen.insert(corners).second) {
      ++repeated;
    } else {
      kept.push_back(f);
    }
  }
  keepTriangles(surface, kept);
  if (flat > 0) warnings->push_back(fmt::format("{}: {} triangles without area were dropped", name, flat));
  if (repeated > 0)
    warnings->push_back(fmt::format("{}: {} repeated triangles were dropped", name, repeated));
}

void orient(WeldedSurface* surface, const std::string& name, Warnings* warnings) {
  const std::vector<bool> turn = trianglesToFlip(surface->mesh);
  for (std::size_t t = 0; t < turn.size(); ++t) {
    if (!turn[t]) continue;
    const auto f = static_cast<Eigen::Index>(t);
    std::swap(surface->mesh.triangles(f, 1), surface->mesh.triangles(f, 2));
    if (surface->texture_coordinates.rows() > 0) {
      surface->texture_coordinates.row(3 * f + 1).swap(surface->texture_coordinates.row(3 * f + 2));
    }
  }
  const auto count = std::count(turn.begin(), turn.end(), true);
  if (count > 0) {
    warnings->push_back(
        fmt::format("{}: {} of {} triangles faced inward and were flipped", name, count, turn.size()));
  }
}

}  // namespace

double sizeOf(const Points& vertices) {
  if (vertices.rows() == 0) return 0.0;
  return (vertices.colwise().maxCoeff() - vertices.colwise().minCoeff()).norm();
}

EdgeReport examineEdges(const Triangles& triangles) {
  std::map<std::pair<int, int>, std::array<int, 2>> uses;  // in ascending and in descending direction
  for (Eigen::Index f = 0; f < triangles.rows(); ++f) {
    for (int k = 0; k < 3; ++k) {
      const int a = triangles(f, k), b = triangles(f, (k + 1) % 3);
      ++uses[std::minmax(a, b)][a < b ? 0 : 1];
    }
  }
  EdgeReport report;
  for (const auto& [edge, count] : uses) {
    const int total = count[0] + count[1];
    if (total == 1) ++report.open;
    if (total > 2) ++report.branching;
    if (total == 2 && count[0] != 1) ++report.inconsistent;
    if (total != 2) report.example = {edge.first, edge.second};
  }
  return report;
}

WeldedSurface repairSurface(const SurfaceFile& file, const std::string& name, Warnings* warnings) {
  WeldedSurface surface{file.mesh, file.texture_coordinates, {}};
  weld(&surface, name, warnings);
  dropUseless(&surface, name, warnings);
  if (surface.mesh.triangles.rows() == 0) throw std::invalid_argument(name + ": no triangle has an area");
  orient(&surface, name, warnings);
  return surface;
}

WeldedSurface loadSurface(const std::string& path, double unit_m, Warnings* warnings) {
  SurfaceFile file = readSurfaceFile(path, warnings);
  file.mesh.vertices *= unit_m;
  return repairSurface(file, path, warnings);
}

}  // namespace softbody
