#include "io/tet_repair.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <stdexcept>

#include "softbody_common/files/stack_rows.h"
#include "softbody_common/geometry/tet_geometry.h"

namespace softbody {
namespace {

/// Volume over cubed longest edge, below which a tet counts as flat.
constexpr double kFlat = 1e-9;

std::array<int, 4> sortedCorners(const Eigen::RowVector4i& tet) {
  std::array<int, 4> corners{tet[0], tet[1], tet[2], tet[3]};
  std::sort(corners.begin(), corners.end());
  return corners;
}

double longestEdge(const Points& vertices, const Eigen::RowVector4i& tet) {
  double longest = 0.0;
  for (int i = 0; i < 4; ++i) {
    for (int j = i + 1; j < 4; ++j)
      longest = std::max(longest, (vertices.row(tet[i]) - vertices.row(tet[j])).norm());
  }
  return longest;
}

/// The tets with positive orientation. Flat and repeated ones are dropped.
std::vector<Eigen::RowVector4i> soundTets(const std::string& path, const TetMesh& mesh,
                                          std::vector<std::string>* warnings) {
  const Eigen::VectorXd volumes = tetVolumes(mesh.vertices, mesh.tets);
  std::vector<Eigen::RowVector4i> kept;
  std::set<std::array<int, 4>> seen;
  int reordered = 0, flat = 0, repeated = 0;
  for (Eigen::Index t = 0; t < mesh.tets.rows(); ++t) {
    Eigen::RowVector4i tet = mesh.tets.row(t);
    const double edge = longestEdge(mesh.vertices, tet);
    if (!(std::abs(volumes[t]) > kFlat * edge * edge * edge)) {
      if (flat++ == 0) warnings->push_back(fmt::format("{}: tet {} has no volume and was dropped", path, t));
    } else if (!seen.insert(sortedCorners(tet)).second) {
      if (repeated++ == 0)
        warnings->push_back(fmt::format("{}: tet {} is repeated and was dropped", path, t));
    } else {
      if (volumes[t] < 0.0) {
        std::swap(tet[2], tet[3]);
        ++reordered;
      }
      kept.push_back(tet);
    }
  }
  if (flat > 1)
    warnings->push_back(fmt::format("{}: {} tets without volume were dropped in total", path, flat));
  if (repeated > 1)
    warnings->push_back(fmt::format("{}: {} repeated tets were dropped in total", path, repeated));
  // If all tets are negative the file just follows the other convention: no warning.
  if (reordered > 0 && reordered < static_cast<int>(kept.size())) {
    warnings->push_back(fmt::format("{}: {} of {} tets had negative volume and were reordered", path,
                                    reordered, kept.size()));
  }
  return kept;
}

TetMesh withoutUnusedVertices(const std::string& path, const TetMesh& mesh,
                              std::vector<std::string>* warnings) {
  std::vector<int> index(static_cast<std::size_t>(mesh.vertices.rows()), -1);
  for (const int vertex : mesh.tets.reshaped()) index[static_cast<std::size_t>(vertex)] = 0;
  std::vector<Eigen::RowVector3d> used;
  for (std::size_t v = 0; v < index.size(); ++v) {
    if (index[v] < 0) continue;
    index[v] = static_cast<int>(used.size());
    used.push_back(mesh.vertices.row(static_cast<Eigen::Index>(v)));
  }
  if (used.size() == index.size()) return mesh;
  warnings->push_back(
      fmt::format("{}: {} vertices without a tet were dropped", path, index.size() - used.size()));
  return {stackRows<Points>(used),
          mesh.tets.unaryExpr([&index](int v) { return index[static_cast<std::size_t>(v)]; })};
}

/// @throw std::invalid_argument if a face belongs to more than two tets.
void checkFaces(const std::string& path, const Tets& tets) {
  std::map<std::array<int, 3>, int> uses;
  for (Eigen::Index t = 0; t < tets.rows(); ++t) {
    const std::array<int, 4> corners = sortedCorners(tets.row(t));
    for (int left_out = 0; left_out < 4; ++left_out) {
      std::array<int, 3> face{};
      for (int k = 0, n = 0; k < 4; ++k) {
        if (k != left_out) face[static_cast<std::size_t>(n++)] = corners[static_cast<std::size_t>(k)];
      }
      if (++uses[face] <= 2) continue;
      throw std::invalid_argument(
          fmt::format("{}: tet {}: its face of vertices {}, {}, {} belongs to three tets", path, t, face[0],
                      face[1], face[2]));
    }
  }
}

}  // namespace

TetMesh repairTets(TetMesh mesh, const std::string& path, std::vector<std::string>* warnings) {
  mesh.tets = stackRows<Tets>(soundTets(path, mesh, warnings));
  if (mesh.tets.rows() == 0)
    throw std::invalid_argument(path +
                                ": no tet of positive volume; check the unit, and whether the mesh is flat");
  checkFaces(path, mesh.tets);
  return withoutUnusedVertices(path, mesh, warnings);
}

}  // namespace softbody
