#include "prediction/predicted_surface.h"

#include <Eigen/Dense>
#include <algorithm>

#include "softbody_common/surface_binding.h"
#include "softbody_common/tet_geometry.h"
#include "softbody_common/tet_locator.h"

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

PredictedSurface::PredictedSurface(const TetTopology& volume, const MeshTopology& surface)
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

void PredictedSurface::render(const Pinhole& camera, const Points& volume_vertices) {
  camera_ = camera;
  volume_vertices_ = volume_vertices;
  vertices_ = applyBinding(binding_, volume_vertices, volume_.tets);
  motions_.clear();
  rasterize(camera, vertices_, surface_.triangles, &image_, faces_);
}

std::vector<Points> PredictedSurface::pieceVertices() const {
  std::vector<Points> result;
  for (const std::vector<int>& piece : pieces_) result.emplace_back(volume_vertices_(piece, Eigen::all));
  return result;
}

Points PredictedSurface::movedVolume(const RigidMotions& motions) const {
  Points moved(volume_vertices_.rows(), 3);
  for (Eigen::Index v = 0; v < moved.rows(); ++v) {
    moved.row(v) = motions[vertex_pieces_[v]] * volume_vertices_.row(v).transpose();
  }
  return moved;
}

void PredictedSurface::move(const RigidMotions& motions) {
  volume_vertices_ = movedVolume(motions);
  motions_.resize(pieceCount(), Eigen::Isometry3d::Identity());
  for (std::size_t piece = 0; piece < pieceCount(); ++piece)
    motions_[piece] = motions[piece] * motions_[piece];
}

bool PredictedSurface::isAtCut(int triangle) const {
  const auto corners = surface_.triangles.row(triangle);
  return at_cut_[corners[0]] || at_cut_[corners[1]] || at_cut_[corners[2]];
}

/// A triangle's corners as columns, camera frame [m].
Eigen::Matrix3d PredictedSurface::corners(int triangle) const {
  Eigen::Matrix3d corners;
  for (int k = 0; k < 3; ++k) corners.col(k) = vertices_.row(surface_.triangles(triangle, k));
  if (motions_.empty()) return corners;
  return motions_[pieceOfTriangle(triangle)] * corners;
}

int PredictedSurface::triangleAt(const Eigen::Vector3d& measured, double tolerance) const {
  for (std::size_t piece = 0; piece < pieceCount(); ++piece) {
    const Eigen::Vector3d rendered =
        motions_.empty() ? measured : Eigen::Vector3d(motions_[piece].inverse(Eigen::Isometry) * measured);
    if (!(rendered.z() > 0.0)) continue;
    const Eigen::Vector2d pixel = camera_.project(rendered);
    if (!camera_.contains(pixel.x(), pixel.y())) continue;
    const cv::Point nearest(cvRound(pixel.x()), cvRound(pixel.y()));
    const int triangle = image_.triangle(nearest);
    if (triangle < 0 || std::abs(rendered.z() - image_.depth(nearest)) > tolerance) continue;
    if (pieceOfTriangle(triangle) == piece) return triangle;
  }
  return -1;
}

/// The point of the rest shape where the ray through a pixel meets a triangle's plane.
Eigen::Vector3d PredictedSurface::restPoint(int triangle, const cv::Point2f& pixel) const {
  const Eigen::Vector3d weights = rayWeights(camera_, corners(triangle), pixel.x, pixel.y);
  Eigen::Vector3d rest = Eigen::Vector3d::Zero();
  for (int k = 0; k < 3; ++k)
    rest += weights[k] * surface_.rest_vertices.row(surface_.triangles(triangle, k)).transpose();
  return rest;
}

Eigen::Vector4d PredictedSurface::barycentric(int tet, const Eigen::Vector3d& rest) const {
  const Eigen::Vector3d weights =
      rest_inverse_[tet] * (rest - volume_.rest_vertices.row(volume_.tets(tet, 0)).transpose());
  return {1.0 - weights.sum(), weights.x(), weights.y(), weights.z()};
}

MaterialPoint PredictedSurface::materialPoint(int triangle, const cv::Point2f& pixel) const {
  const Eigen::Vector3d rest = restPoint(triangle, pixel);
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

PlaceGradient PredictedSurface::placeGradient(const MaterialPoint& place, int triangle,
                                              const cv::Point2f& pixel) const {
  PlaceGradient gradient;
  gradient.col(0) = barycentric(place.tet, restPoint(triangle, pixel + cv::Point2f(1, 0)));
  gradient.col(1) = barycentric(place.tet, restPoint(triangle, pixel + cv::Point2f(0, 1)));
  return gradient.colwise() - place.barycentric;
}

Eigen::Matrix2f PredictedSurface::imageWarp(const MaterialPoint& place, const PlaceGradient& gradient) const {
  Eigen::Matrix<double, 3, 4> corners;
  for (int k = 0; k < 4; ++k) corners.col(k) = volume_vertices_.row(volume_.tets(place.tet, k));
  const Eigen::Vector3d p = corners * place.barycentric;
  const Eigen::Matrix<double, 3, 2> offsets = corners * gradient;
  Eigen::Matrix<double, 2, 3> projection;
  projection << camera_.fx / p.z(), 0.0, -camera_.fx * p.x() / (p.z() * p.z()),  //
      0.0, camera_.fy / p.z(), -camera_.fy * p.y() / (p.z() * p.z());
  return (projection * offsets).cast<float>();
}

Eigen::Vector3d PredictedSurface::normal(int triangle) const {
  const Eigen::Matrix3d c = corners(triangle);
  return (c.col(1) - c.col(0)).cross(c.col(2) - c.col(0)).normalized();
}

Eigen::Vector3d PredictedSurface::position(const MaterialPoint& place) const {
  return positionOf(place, volume_vertices_, volume_.tets);
}

}  // namespace softbody
