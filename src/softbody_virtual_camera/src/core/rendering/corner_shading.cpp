#include "softbody_virtual_camera/rendering/corner_shading.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <map>

namespace softbody::virtual_camera {
namespace {

/// Normals with twice the area of the triangle as length.
Points areaNormals(const Points& vertices, const Triangles& triangles) {
  Points normals(triangles.rows(), 3);
  for (Eigen::Index f = 0; f < triangles.rows(); ++f) {
    const Eigen::Vector3d a = vertices.row(triangles(f, 0)), b = vertices.row(triangles(f, 1)),
                          c = vertices.row(triangles(f, 2));
    normals.row(f) = (b - a).cross(c - a);
  }
  return normals;
}

/// The triangles around each vertex.
std::vector<std::vector<int>> trianglesAround(const TriangleMesh& mesh) {
  std::vector<std::vector<int>> around(static_cast<std::size_t>(mesh.vertices.rows()));
  for (Eigen::Index f = 0; f < mesh.triangles.rows(); ++f) {
    for (int k = 0; k < 3; ++k)
      around[static_cast<std::size_t>(mesh.triangles(f, k))].push_back(static_cast<int>(f));
  }
  return around;
}

}  // namespace

void CornerShading::add(const TriangleMesh& rest, double crease_angle_rad) {
  const std::size_t first_triangle = normal_.size() / 3;
  normal_.resize(normal_.size() + 3 * static_cast<std::size_t>(rest.triangles.rows()));
  const Points normals = areaNormals(rest.vertices, rest.triangles).rowwise().normalized();
  const double least_cosine = std::cos(crease_angle_rad);
  const std::vector<std::vector<int>> around = trianglesAround(rest);
  for (std::size_t vertex = 0; vertex < around.size(); ++vertex) {
    std::map<std::vector<int>, int> shared;
    for (const int f : around[vertex]) {
      std::vector<int> smooth;
      for (const int g : around[vertex]) {
        if (normals.row(f).dot(normals.row(g)) >= least_cosine) smooth.push_back(g);
      }
      const auto [entry, fresh] = shared.emplace(smooth, static_cast<int>(first_.size()) - 1);
      if (fresh) {
        for (const int g : smooth) triangles_.push_back(static_cast<int>(first_triangle) + g);
        first_.push_back(triangles_.size());
      }
      for (int k = 0; k < 3; ++k) {
        if (rest.triangles(f, k) != static_cast<int>(vertex)) continue;
        normal_[3 * (first_triangle + static_cast<std::size_t>(f)) + static_cast<std::size_t>(k)] =
            entry->second;
      }
    }
  }
}

void CornerShading::light(const Points& vertices, const Triangles& triangles, const Lights& lights) {
  const Points normals = areaNormals(vertices, triangles);
  brightness_.resize(first_.size() - 1);
  for (std::size_t i = 0; i < brightness_.size(); ++i) {
    Eigen::RowVector3d normal = Eigen::RowVector3d::Zero();
    for (std::size_t j = first_[i]; j < first_[i + 1]; ++j) normal += normals.row(triangles_[j]);
    normal.normalize();
    const float main = static_cast<float>(std::max(0.0, normal.dot(lights.to_main))),
                fill = static_cast<float>(std::max(0.0, normal.dot(lights.to_fill)));
    brightness_[i] = lights.ambient + (1.0f - lights.ambient - lights.fill) * main + lights.fill * fill;
  }
}

}  // namespace softbody::virtual_camera
