#include "prediction/surface_model.h"

#include <Eigen/Dense>
#include <algorithm>

#include "softbody_common/geometry/surface_binding.h"
#include "softbody_common/geometry/tet_geometry.h"
#include "softbody_common/geometry/tet_locator.h"

namespace softbody {

namespace {

// Cosine of the smallest angle between two sides that light shows as a crease: 40 degrees.
constexpr double kCreaseCosine = 0.766;

Eigen::Vector3d normalOf(const Points& vertices, const Eigen::RowVector3i& triangle) {
  const Eigen::Vector3d a = vertices.row(triangle[0]), b = vertices.row(triangle[1]),
                        c = vertices.row(triangle[2]);
  return (b - a).cross(c - a).normalized();
}

/// For each triangle, whether another triangle at one of its vertices has quite another normal.
std::vector<bool> trianglesAtCreases(const MeshTopology& surface) {
  const Eigen::Index count = surface.triangles.rows();
  std::vector<Eigen::Vector3d> normals;
  std::vector<std::vector<Eigen::Index>> around(static_cast<std::size_t>(surface.rest_vertices.rows()));
  for (Eigen::Index t = 0; t < count; ++t) {
    normals.push_back(normalOf(surface.rest_vertices, surface.triangles.row(t)));
    for (int k = 0; k < 3; ++k) around[static_cast<std::size_t>(surface.triangles(t, k))].push_back(t);
  }
  std::vector<bool> at_crease(static_cast<std::size_t>(count), false);
  for (const std::vector<Eigen::Index>& triangles : around) {
    for (const Eigen::Index a : triangles) {
      for (const Eigen::Index b : triangles) {
        if (normals[static_cast<std::size_t>(a)].dot(normals[static_cast<std::size_t>(b)]) < kCreaseCosine)
          at_crease[static_cast<std::size_t>(a)] = true;
      }
    }
  }
  return at_crease;
}

}  // namespace

SurfaceModel::SurfaceModel(const TetTopology& volume, const MeshTopology& surface)
    : volume_(volume),
      surface_(surface),
      faces_(isClosed(surface.triangles) ? Faces::kFront : Faces::kAll),
      tet_pieces_(tetPieces(volume.tets, static_cast<int>(volume.rest_vertices.rows()))),
      vertex_pieces_(vertexPieces(volume.tets, tet_pieces_, volume.rest_vertices.rows())),
      pieces_(verticesOfPieces(volume.tets, volume.rest_vertices.rows())),
      at_cut_(static_cast<std::size_t>(surface.rest_vertices.rows()), false),
      at_crease_(trianglesAtCreases(surface)),
      has_creases_(std::find(at_crease_.begin(), at_crease_.end(), true) != at_crease_.end()),
      binding_(bindSurface(surface, volume)) {
  surface_pieces_.resize(pieces_.size());
  for (std::size_t t = 0; t < surface.triangle_pieces.size(); ++t)
    surface_pieces_[pieceOfTriangle(static_cast<int>(t))].insert(surface.triangle_pieces[t]);
  for (std::size_t t = 0; t < surface.cut.size(); ++t) {
    if (!surface.cut[t]) continue;
    for (int k = 0; k < 3; ++k) at_cut_[surface.triangles(static_cast<Eigen::Index>(t), k)] = true;
  }
  rest_inverse_.reserve(static_cast<std::size_t>(volume.tets.rows()));
  for (Eigen::Index t = 0; t < volume.tets.rows(); ++t) {
    Eigen::Matrix3d edges;
    for (int k = 0; k < 3; ++k) {
      edges.col(k) =
          volume.rest_vertices.row(volume.tets(t, k + 1)) - volume.rest_vertices.row(volume.tets(t, 0));
    }
    rest_inverse_.emplace_back(edges.inverse());
  }
}

Points SurfaceModel::surfaceVertices(const Points& volume_vertices) const {
  return applyBinding(binding_, volume_vertices, volume_.tets);
}

Points SurfaceModel::moved(const Points& volume_vertices, const RigidMotions& motions) const {
  Points moved(volume_vertices.rows(), 3);
  for (Eigen::Index v = 0; v < moved.rows(); ++v) {
    moved.row(v) = motions[vertex_pieces_[v]] * volume_vertices.row(v).transpose();
  }
  return moved;
}

bool SurfaceModel::isAtCut(int triangle) const {
  const auto corners = surface_.triangles.row(triangle);
  return at_cut_[corners[0]] || at_cut_[corners[1]] || at_cut_[corners[2]];
}

MaterialPoint SurfaceModel::placeOf(const Eigen::Vector3d& rest, int triangle) const {
  // A tet with one of the triangle's corners contains the point, or nearly; this is far cheaper than a
  // search.
  MaterialPoint best;
  for (int k = 0; k < 3; ++k) {
    const int tet = binding_[surface_.triangles(triangle, k)].tet;
    if (tet == best.tet) continue;
    const Eigen::Vector4d weights = barycentric(tet, rest);
    if (best.tet < 0 || weights.minCoeff() > best.barycentric.minCoeff()) best = {tet, weights};
    if (best.barycentric.minCoeff() >= 0.0) break;
  }
  return best;
}

Eigen::Vector4d SurfaceModel::barycentric(int tet, const Eigen::Vector3d& rest) const {
  const Eigen::Vector3d weights =
      rest_inverse_[tet] * (rest - volume_.rest_vertices.row(volume_.tets(tet, 0)).transpose());
  return {1.0 - weights.sum(), weights.x(), weights.y(), weights.z()};
}

}  // namespace softbody
