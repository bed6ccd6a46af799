#include "shells/hole_filling.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/triangulate_hole.h>
#include <CGAL/utility.h>

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <utility>
#include <vector>

namespace softbody {
namespace {

using Point = CGAL::Exact_predicates_inexact_constructions_kernel::Point_3;
using CapTriangle = std::array<int, 3>;

/// The search needs memory for each pair of rim vertices.
constexpr std::size_t kLongestSearchedRim = 500;

/// The end of each open edge by its start, against the direction of its triangle.
std::multimap<int, int> openEdges(const Triangles& triangles) {
  std::set<std::pair<int, int>> directed;
  std::map<std::pair<int, int>, int> uses;
  for (const auto& t : triangles.rowwise()) {
    for (int k = 0; k < 3; ++k) {
      directed.emplace(t[k], t[(k + 1) % 3]);
      ++uses[std::minmax(t[k], t[(k + 1) % 3])];
    }
  }
  std::multimap<int, int> open;
  for (const auto& [a, b] : directed) {
    if (uses.at(std::minmax(a, b)) == 1) open.emplace(b, a);
  }
  return open;
}

/// The rims of the holes. A rim that touches itself at a vertex is two rims.
std::vector<std::vector<int>> rimsOf(const Triangles& triangles) {
  std::multimap<int, int> open = openEdges(triangles);
  std::vector<std::vector<int>> rims;
  while (!open.empty()) {
    std::vector<int> trail{open.begin()->first};
    for (auto next = open.begin(); next != open.end(); next = open.find(trail.back())) {
      const int vertex = next->second;
      open.erase(next);
      const auto met = std::find(trail.begin(), trail.end(), vertex);
      if (met != trail.end()) {
        rims.emplace_back(met, trail.end());
        trail.erase(met + 1, trail.end());
      } else {
        trail.push_back(vertex);
      }
    }
  }
  rims.erase(std::remove_if(rims.begin(), rims.end(), [](const auto& rim) { return rim.size() < 3; }),
             rims.end());
  return rims;
}

/// Triangles between the vertices of a rim; none if that fails.
std::vector<CapTriangle> spanned(const Points& vertices, const std::vector<int>& rim) {
  std::vector<Point> points;
  for (const int v : rim) points.emplace_back(vertices(v, 0), vertices(v, 1), vertices(v, 2));
  std::vector<CGAL::Triple<int, int, int>> patch;
  CGAL::Polygon_mesh_processing::triangulate_hole_polyline(
      points, std::back_inserter(patch),
      CGAL::parameters::use_delaunay_triangulation(rim.size() <= kLongestSearchedRim)
          .do_not_use_cubic_algorithm(true));
  std::vector<CapTriangle> triangles;
  for (const auto& t : patch) {
    const auto at = [&rim](int k) { return rim[static_cast<std::size_t>(k)]; };
    triangles.push_back({at(t.first), at(t.second), at(t.third)});
  }
  return triangles;
}

/// Whether the triangles run along the rim in its direction.
bool followsRim(const std::vector<CapTriangle>& triangles, int start, int end) {
  return std::any_of(triangles.begin(), triangles.end(), [=](const CapTriangle& t) {
    for (std::size_t k = 0; k < 3; ++k)
      if (t[k] == start && t[(k + 1) % 3] == end) return true;
    return false;
  });
}

std::vector<CapTriangle> fan(const std::vector<int>& rim, WeldedSurface* surface) {
  Points& vertices = surface->mesh.vertices;
  const auto middle = static_cast<int>(vertices.rows());
  vertices.conservativeResize(middle + 1, 3);
  vertices.row(middle) = vertices(rim, Eigen::all).colwise().mean();
  surface->vertex_parents.push_back(-1);
  std::vector<CapTriangle> triangles;
  for (std::size_t k = 0; k < rim.size(); ++k)
    triangles.push_back({rim[k], rim[(k + 1) % rim.size()], middle});
  return triangles;
}

void append(const std::vector<CapTriangle>& added, WeldedSurface* surface) {
  Triangles& triangles = surface->mesh.triangles;
  Points& texture = surface->texture_coordinates;
  const Eigen::Index before = triangles.rows();
  std::map<int, Eigen::RowVector3d> rim_texture;
  for (Eigen::Index corner = 0; corner < texture.rows(); ++corner)
    rim_texture.emplace(triangles(corner / 3, corner % 3), texture.row(corner));
  triangles.conservativeResize(before + static_cast<Eigen::Index>(added.size()), 3);
  if (texture.rows() > 0) texture.conservativeResize(3 * triangles.rows(), 3);
  for (std::size_t t = 0; t < added.size(); ++t) {
    const Eigen::Index row = before + static_cast<Eigen::Index>(t);
    for (int k = 0; k < 3; ++k) {
      const int vertex = added[t][static_cast<std::size_t>(k)];
      triangles(row, k) = vertex;
      if (texture.rows() == 0) continue;
      const auto known = rim_texture.find(vertex);
      texture.row(3 * row + k) = known != rim_texture.end() ? known->second : rim_texture.at(added[t][0]);
    }
  }
}

}  // namespace

FilledHoles fillHoles(WeldedSurface* surface) {
  FilledHoles filled;
  std::vector<CapTriangle> added;
  for (const std::vector<int>& rim : rimsOf(surface->mesh.triangles)) {
    std::vector<CapTriangle> patch = spanned(surface->mesh.vertices, rim);
    if (patch.empty()) patch = fan(rim, surface);
    if (!followsRim(patch, rim[0], rim[1]))
      for (CapTriangle& t : patch) std::swap(t[1], t[2]);
    added.insert(added.end(), patch.begin(), patch.end());
    const Points places = surface->mesh.vertices(rim, Eigen::all);
    ++filled.count;
    if (sizeOf(places) < filled.widest) continue;
    filled.widest = sizeOf(places);
    filled.place = places.colwise().mean();
  }
  if (!added.empty()) append(added, surface);
  return filled;
}

}  // namespace softbody
