#include "surface/mesh_layout.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <tuple>

namespace softbody {
namespace {

/// Disjoint sets of corners; a corner is 3 * triangle + place in it.
class CornerSets {
 public:
  explicit CornerSets(int count) : parents_(static_cast<std::size_t>(count)) {
    std::iota(parents_.begin(), parents_.end(), 0);
  }

  int rootOf(int corner) {
    while (parents_[corner] != corner) corner = parents_[corner] = parents_[parents_[corner]];
    return corner;
  }

  void join(int a, int b) { parents_[rootOf(a)] = rootOf(b); }

 private:
  std::vector<int> parents_;
};

/// An edge as one triangle sees it.
struct Side {
  std::array<int, 2> ends;     // ascending
  std::array<int, 2> corners;  // at these ends
};

std::vector<Side> sidesByEdge(const Triangles& triangles) {
  std::vector<Side> sides;
  sides.reserve(static_cast<std::size_t>(triangles.size()));
  for (int t = 0; t < triangles.rows(); ++t) {
    for (int k = 0; k < 3; ++k) {
      const int next = (k + 1) % 3;
      Side side{{triangles(t, k), triangles(t, next)}, {3 * t + k, 3 * t + next}};
      if (side.ends[0] > side.ends[1]) {
        std::swap(side.ends[0], side.ends[1]);
        std::swap(side.corners[0], side.corners[1]);
      }
      sides.push_back(side);
    }
  }
  std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) {
    return std::tie(a.ends, a.corners) < std::tie(b.ends, b.corners);
  });
  return sides;
}

/// Normals of the triangles, twice as long as their areas.
Points areaNormals(const Points& vertices, const Triangles& triangles) {
  Points normals(triangles.rows(), 3);
  for (Eigen::Index t = 0; t < triangles.rows(); ++t) {
    const Eigen::Vector3d a = vertices.row(triangles(t, 0));
    const Eigen::Vector3d ab = vertices.row(triangles(t, 1)).transpose() - a;
    const Eigen::Vector3d ac = vertices.row(triangles(t, 2)).transpose() - a;
    normals.row(t) = ab.cross(ac);
  }
  return normals;
}

/// Index of the normal at each corner.
Triangles smoothCorners(const MeshTopology& topology, double crease_angle, int* count) {
  const Triangles& triangles = topology.triangles;
  const Points unit = areaNormals(topology.rest_vertices, triangles).rowwise().normalized();
  const double least_cosine = std::cos(crease_angle);
  CornerSets sets(static_cast<int>(triangles.size()));
  const std::vector<Side> sides = sidesByEdge(triangles);
  for (std::size_t i = 1; i < sides.size(); ++i) {
    const Side &a = sides[i - 1], &b = sides[i];
    const int s = a.corners[0] / 3, t = b.corners[0] / 3;
    if (a.ends != b.ends || topology.cut[s] != topology.cut[t]) continue;
    if (unit.row(s).dot(unit.row(t)) < least_cosine) continue;
    for (int k = 0; k < 2; ++k) sets.join(a.corners[k], b.corners[k]);
  }
  Triangles normals(triangles.rows(), 3);
  std::vector<int> numbers(static_cast<std::size_t>(triangles.size()), -1);
  *count = 0;
  for (int corner = 0; corner < triangles.size(); ++corner) {
    int& number = numbers[sets.rootOf(corner)];
    if (number < 0) number = (*count)++;
    normals(corner / 3, corner % 3) = number;
  }
  return normals;
}

}  // namespace

MeshLayout layoutOfSurface(const MeshTopology& topology, double crease_angle) {
  MeshLayout layout;
  layout.corner_normals = smoothCorners(topology, crease_angle, &layout.normal_count);
  layout.parts.resize(2);
  const bool textured = topology.texture_coordinates.rows() > 0;
  std::map<std::tuple<int, float, float>, std::uint32_t> drawn;
  for (int corner = 0; corner < topology.triangles.size(); ++corner) {
    const int triangle = corner / 3, normal = layout.corner_normals(triangle, corner % 3);
    Eigen::Vector2f texture = Eigen::Vector2f::Zero();
    if (textured) texture = topology.texture_coordinates.row(corner).head<2>().cast<float>();
    const auto [place, is_new] = drawn.try_emplace({normal, texture.x(), texture.y()},
                                                   static_cast<std::uint32_t>(layout.vertices.size()));
    layout.parts[topology.cut[triangle] ? 1 : 0].push_back(place->second);
    if (!is_new) continue;
    layout.vertices.push_back(topology.triangles(triangle, corner % 3));
    layout.normals.push_back(normal);
    layout.triangles.push_back(triangle);
    if (textured) layout.texture.push_back(texture);
  }
  return layout;
}

MeshLayout layoutOfFacets(const Triangles& triangles) {
  MeshLayout layout;
  layout.parts.resize(1);
  layout.normal_count = static_cast<int>(triangles.rows());
  layout.corner_normals.resize(triangles.rows(), 3);
  for (int corner = 0; corner < triangles.size(); ++corner) {
    const int triangle = corner / 3;
    layout.corner_normals(triangle, corner % 3) = triangle;
    layout.vertices.push_back(triangles(triangle, corner % 3));
    layout.normals.push_back(triangle);
    layout.triangles.push_back(triangle);
    layout.parts[0].push_back(static_cast<std::uint32_t>(corner));
  }
  return layout;
}

std::vector<PlacedVertex> place(const MeshLayout& layout, const Points& vertices,
                                const Triangles& triangles) {
  const Points of_triangles = areaNormals(vertices, triangles);
  Points normals = Points::Zero(layout.normal_count, 3);
  for (Eigen::Index t = 0; t < triangles.rows(); ++t) {
    for (int k = 0; k < 3; ++k) normals.row(layout.corner_normals(t, k)) += of_triangles.row(t);
  }
  std::vector<PlacedVertex> placed(layout.vertices.size());
  for (std::size_t i = 0; i < placed.size(); ++i) {
    placed[i].position = vertices.row(layout.vertices[i]).cast<float>();
    placed[i].normal = normals.row(layout.normals[i]).normalized().cast<float>();
  }
  return placed;
}

}  // namespace softbody
