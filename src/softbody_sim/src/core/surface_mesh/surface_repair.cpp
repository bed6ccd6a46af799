#include "surface_mesh/surface_repair.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <boost/functional/hash.hpp>
#include <limits>
#include <map>
#include <numeric>
#include <stdexcept>
#include <unordered_map>
#include <utility>

#include "surface_mesh/orientation.h"
#include "surface_mesh/weld.h"

namespace softbody {
namespace {

/// Welding distances over the mesh's size: rounding of a file, and of a program that cut the faces apart.
constexpr double kWeldShares[] = {1e-7, 1e-6, 1e-5, 1e-4};
constexpr double kFlatShare = 1e-9;  ///< height of a triangle over its longest edge

void selectTriangles(const std::vector<Eigen::Index>& kept, WeldedSurface* surface) {
  const bool textured = surface->texture_coordinates.rows() > 0;
  std::vector<Eigen::Index> corners;
  for (const Eigen::Index f : kept) corners.insert(corners.end(), {3 * f, 3 * f + 1, 3 * f + 2});
  surface->mesh.triangles = Triangles(surface->mesh.triangles(kept, Eigen::all));
  if (textured) surface->texture_coordinates = Points(surface->texture_coordinates(corners, Eigen::all));
}

/// Renames the corners of the triangles and drops the vertices that none names any more, in file order.
/// @param target per vertex, the vertex that stands for it.
void mergeVertices(const std::vector<int>& target, WeldedSurface* surface) {
  std::vector<int> index(target.size(), -1);
  for (const int vertex : surface->mesh.triangles.reshaped())
    index[static_cast<std::size_t>(target[static_cast<std::size_t>(vertex)])] = 0;
  std::vector<int> kept, parents;
  for (std::size_t v = 0; v < index.size(); ++v) {
    if (index[v] < 0) continue;
    index[v] = static_cast<int>(kept.size());
    kept.push_back(static_cast<int>(v));
    parents.push_back(surface->vertex_parents[v]);
  }
  surface->mesh.vertices = Points(surface->mesh.vertices(kept, Eigen::all));
  surface->vertex_parents = std::move(parents);
  for (int& vertex : surface->mesh.triangles.reshaped())
    vertex = index[static_cast<std::size_t>(target[static_cast<std::size_t>(vertex)])];
}

/// @return number of dropped vertices.
std::ptrdiff_t dropUnusedVertices(WeldedSurface* surface) {
  const auto before = surface->mesh.vertices.rows();
  std::vector<int> same(static_cast<std::size_t>(before));
  std::iota(same.begin(), same.end(), 0);
  mergeVertices(same, surface);
  return before - surface->mesh.vertices.rows();
}

bool isFlat(const Points& vertices, const Eigen::RowVector3i& t) {
  const Eigen::Vector3d a = vertices.row(t[0]), b = vertices.row(t[1]), c = vertices.row(t[2]);
  const double longest = std::max({(b - a).squaredNorm(), (c - b).squaredNorm(), (a - c).squaredNorm()});
  return !((b - a).cross(c - a).norm() > kFlatShare * longest);
}

/// @return number of dropped triangles.
std::ptrdiff_t dropFlatTriangles(WeldedSurface* surface) {
  const Triangles& triangles = surface->mesh.triangles;
  std::vector<Eigen::Index> kept;
  for (Eigen::Index f = 0; f < triangles.rows(); ++f) {
    if (!isFlat(surface->mesh.vertices, triangles.row(f))) kept.push_back(f);
  }
  const auto flat = triangles.rows() - static_cast<Eigen::Index>(kept.size());
  selectTriangles(kept, surface);
  return flat;
}

/// Welds with the shortest distance that leaves the fewest open edges and flattens nothing. @return number of
/// welded vertices.
std::ptrdiff_t weld(WeldedSurface* surface) {
  const WeldedSurface before = *surface;
  const double size = std::max(sizeOf(before.mesh.vertices), 1e-300);
  int fewest = std::numeric_limits<int>::max();
  std::ptrdiff_t flat = 0;
  for (const double share : kWeldShares) {
    WeldedSurface welded = before;
    mergeVertices(firstCoincident(before.mesh.vertices, share * size), &welded);
    const std::ptrdiff_t now_flat = dropFlatTriangles(&welded);
    if (share == kWeldShares[0]) flat = now_flat;
    if (now_flat > flat) break;
    const int open = examineEdges(welded.mesh.triangles).open;
    if (open < fewest) *surface = std::move(welded);
    fewest = std::min(fewest, open);
    if (fewest == 0) break;
  }
  return before.mesh.vertices.rows() - surface->mesh.vertices.rows();
}

/// Number of edges that do not have as many triangles in one direction as in the other.
int unbalancedEdges(const Triangles& triangles, const std::vector<Eigen::Index>& kept) {
  std::unordered_map<std::pair<int, int>, int, boost::hash<std::pair<int, int>>> balance;
  for (const Eigen::Index f : kept) {
    for (int k = 0; k < 3; ++k) {
      const int a = triangles(f, k), b = triangles(f, (k + 1) % 3);
      balance[std::minmax(a, b)] += a < b ? 1 : -1;
    }
  }
  return static_cast<int>(
      std::count_if(balance.begin(), balance.end(), [](const auto& edge) { return edge.second != 0; }));
}

/// Drops triangles with the corners of an earlier one. Those that face the other way stay if they are the
/// back of a two-sided surface: if without them fewer edges were in balance.
/// @return number of dropped triangles.
std::ptrdiff_t dropRepeatedTriangles(bool keep_backs, WeldedSurface* surface) {
  const Triangles& triangles = surface->mesh.triangles;
  using Corners = std::array<int, 3>;
  std::unordered_map<Corners, unsigned, boost::hash<Corners>> seen;  // bit 0: one way; bit 1: the other
  std::vector<Eigen::Index> once, with_backs;
  for (Eigen::Index f = 0; f < triangles.rows(); ++f) {
    Corners corners{triangles(f, 0), triangles(f, 1), triangles(f, 2)};
    std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
    const unsigned way = corners[1] < corners[2] ? 1 : 2;
    std::sort(corners.begin(), corners.end());
    unsigned& ways = seen[corners];
    if (ways == 0) once.push_back(f);
    if ((ways & way) == 0) with_backs.push_back(f);
    ways |= way;
  }
  keep_backs = keep_backs && once.size() < with_backs.size() &&
               unbalancedEdges(triangles, with_backs) < unbalancedEdges(triangles, once);
  const std::vector<Eigen::Index>& kept = keep_backs ? with_backs : once;
  const auto repeated = triangles.rows() - static_cast<Eigen::Index>(kept.size());
  selectTriangles(kept, surface);
  return repeated;
}

/// Sentences about what was dropped or changed, where there was any.
class Notes {
 public:
  Notes(const std::string& name, Warnings* warnings) : name_(name), warnings_(warnings) {}
  void add(std::ptrdiff_t count, const char* what) {
    if (count > 0) warnings_->push_back(fmt::format("{}: {} {}", name_, count, what));
  }

 private:
  const std::string& name_;
  Warnings* warnings_;
};

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

void keepTriangles(const std::vector<Eigen::Index>& kept, WeldedSurface* surface) {
  selectTriangles(kept, surface);
  dropUnusedVertices(surface);
}

std::ptrdiff_t flipTriangles(const std::vector<bool>& flip, WeldedSurface* surface) {
  for (std::size_t t = 0; t < flip.size(); ++t) {
    if (!flip[t]) continue;
    const auto f = static_cast<Eigen::Index>(t);
    std::swap(surface->mesh.triangles(f, 1), surface->mesh.triangles(f, 2));
    if (surface->texture_coordinates.rows() > 0)
      surface->texture_coordinates.row(3 * f + 1).swap(surface->texture_coordinates.row(3 * f + 2));
  }
  return std::count(flip.begin(), flip.end(), true);
}

/// Vertices without a triangle and the far ends of flat ones go first: the welding distance is a share of
/// the size.
WeldedSurface repairSurface(const SurfaceFile& file, const std::string& name, Warnings* warnings,
                            SurfaceKind kind) {
  WeldedSurface surface{file.mesh, file.texture_coordinates, {}};
  surface.vertex_parents.resize(static_cast<std::size_t>(file.mesh.vertices.rows()));
  std::iota(surface.vertex_parents.begin(), surface.vertex_parents.end(), 0);
  Notes notes(name, warnings);
  notes.add(dropUnusedVertices(&surface), "vertices that no triangle uses were dropped");
  const Eigen::Index triangles = surface.mesh.triangles.rows();
  dropFlatTriangles(&surface);
  notes.add(dropUnusedVertices(&surface), "vertices of triangles without area were dropped");
  notes.add(weld(&surface), "coincident vertices were welded");
  notes.add(triangles - surface.mesh.triangles.rows(), "triangles without area were dropped");
  notes.add(dropRepeatedTriangles(kind == SurfaceKind::kSolid, &surface), "repeated triangles were dropped");
  dropUnusedVertices(&surface);
  if (surface.mesh.triangles.rows() == 0) throw std::invalid_argument(name + ": no triangle has an area");
  notes.add(flipTriangles(trianglesToFlip(surface.mesh.triangles), &surface),
            "triangles faced the other way than their neighbours and were flipped");
  return surface;
}

WeldedSurface loadSurface(const std::string& path, double unit_m, Warnings* warnings, SurfaceKind kind) {
  SurfaceFile file = readSurfaceFile(path, warnings);
  file.mesh.vertices *= unit_m;
  return repairSurface(file, path, warnings, kind);
}

}  // namespace softbody
