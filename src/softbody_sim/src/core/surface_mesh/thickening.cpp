#include "surface_mesh/thickening.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <set>
#include <stdexcept>
#include <utility>

namespace softbody {
namespace {

/// Mean of the triangles' normals, weighted by area.
Points vertexNormals(const TriangleMesh& mesh) {
  Points normals = Points::Zero(mesh.vertices.rows(), 3);
  for (const auto& t : mesh.triangles.rowwise()) {
    const Eigen::RowVector3d a = mesh.vertices.row(t[0]), b = mesh.vertices.row(t[1]),
                             c = mesh.vertices.row(t[2]);
    const Eigen::RowVector3d normal = (b - a).cross(c - a);
    for (const int v : t) normals.row(v) += normal;
  }
  normals.rowwise().normalize();
  return normals;
}

void requireSheet(const Triangles& triangles, const std::string& name) {
  const EdgeReport edges = examineEdges(triangles);
  if (edges.open == 0)
    throw std::invalid_argument(
        name + ": has no open edges, so it cannot get a thickness as a sheet; leave out --thickness");
  if (edges.branching > 0 || edges.inconsistent > 0) {
    throw std::invalid_argument(
        fmt::format("{}: cannot get a thickness: {} edges have more than two triangles, and at {} the sides "
                    "are not clear",
                    name, edges.branching, edges.inconsistent));
  }
}

/// Triangles and the rows of their texture coordinates, in the same order.
class SheetBuilder {
 public:
  SheetBuilder(const WeldedSurface& sheet, Eigen::Index open_edges) : sheet_(sheet) {
    const Eigen::Index count = 2 * sheet.mesh.triangles.rows() + 2 * open_edges;
    result_.mesh.triangles.resize(count, 3);
    if (sheet.texture_coordinates.rows() > 0) result_.texture_coordinates.resize(3 * count, 3);
  }

  /// A corner is a vertex and the texture row that it takes.
  using Corner = std::pair<int, Eigen::Index>;
  void add(const Corner& a, const Corner& b, const Corner& c) {
    result_.mesh.triangles.row(next_) << a.first, b.first, c.first;
    if (result_.texture_coordinates.rows() > 0) {
      Eigen::Index row = 3 * next_;
      for (const Corner& corner : {a, b, c})
        result_.texture_coordinates.row(row++) = sheet_.texture_coordinates.row(corner.second);
    }
    ++next_;
  }

  WeldedSurface take() { return std::move(result_); }

 private:
  const WeldedSurface& sheet_;
  WeldedSurface result_;
  Eigen::Index next_ = 0;
};

std::set<std::pair<int, int>> directedEdges(const Triangles& triangles) {
  std::set<std::pair<int, int>> edges;
  for (const auto& t : triangles.rowwise())
    for (int k = 0; k < 3; ++k) edges.emplace(t[k], t[(k + 1) % 3]);
  return edges;
}

}  // namespace

WeldedSurface thickened(const WeldedSurface& sheet, double thickness_m, const std::string& name) {
  const Triangles& triangles = sheet.mesh.triangles;
  requireSheet(triangles, name);
  const int n = static_cast<int>(sheet.mesh.vertices.rows());
  SheetBuilder builder(sheet, examineEdges(triangles).open);
  const std::set<std::pair<int, int>> edges = directedEdges(triangles);
  for (Eigen::Index f = 0; f < triangles.rows(); ++f) {
    const auto at = [&](int k, int side) {
      return SheetBuilder::Corner(triangles(f, k % 3) + side * n, 3 * f + k % 3);
    };
    builder.add(at(0, 0), at(1, 0), at(2, 0));
    builder.add(at(0, 1), at(2, 1), at(1, 1));
    for (int k = 0; k < 3; ++k) {
      if (edges.count({triangles(f, (k + 1) % 3), triangles(f, k)}) > 0) continue;
      builder.add(at(k + 1, 0), at(k, 0), at(k, 1));
      builder.add(at(k + 1, 0), at(k, 1), at(k + 1, 1));
    }
  }
  WeldedSurface body = builder.take();
  const Points shift = 0.5 * thickness_m * vertexNormals(sheet.mesh);
  body.mesh.vertices.resize(2 * n, 3);
  body.mesh.vertices << sheet.mesh.vertices + shift, sheet.mesh.vertices - shift;
  body.vertex_parents = sheet.vertex_parents;
  body.vertex_parents.insert(body.vertex_parents.end(), sheet.vertex_parents.begin(),
                             sheet.vertex_parents.end());
  return body;
}

}  // namespace softbody
