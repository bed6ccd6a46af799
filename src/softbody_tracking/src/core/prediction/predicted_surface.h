#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <set>
#include <vector>

#include "softbody_common/pinhole.h"
#include "softbody_common/rasterizer.h"
#include "softbody_common/types.h"

namespace softbody {

/// A rigid motion for each connected piece of the body; an uncut body has one piece.
using RigidMotions = std::vector<Eigen::Isometry3d>;

/// Change of a MaterialPoint's barycentric coordinates per pixel, 4 by 2.
using PlaceGradient = Eigen::Matrix<double, 4, 2>;

/// The visual surface for a state of the volume, rendered as the camera sees it.
/// All members that depend on the image or on positions need render() first.
class PredictedSurface {
 public:
  PredictedSurface(const TetTopology& volume, const MeshTopology& surface);

  /// Moves the surface with the volume's vertices and renders it. @param volume_vertices camera frame [m].
  void render(const Pinhole& camera, const Points& volume_vertices);

  /// Moves each piece of the body after render(); the image does not change.
  void move(const RigidMotions& motions);

  /// The piece that a place belongs to, and the number of pieces.
  std::uint32_t pieceOf(const MaterialPoint& place) const { return tet_pieces_[place.tet]; }
  std::size_t pieceCount() const { return pieces_.size(); }
  /// Indices of the volume's vertices, for each piece.
  const std::vector<std::vector<int>>& pieces() const { return pieces_; }
  /// For each piece its numbers in MeshTopology::triangle_pieces: one or more; empty if no part of the visual
  /// mesh follows the piece.
  const std::vector<std::set<std::uint32_t>>& piecesOfSurface() const { return surface_pieces_; }
  /// Positions of these vertices, for each piece [m].
  std::vector<Points> pieceVertices() const;
  /// The volume's vertices, each moved by the motion of its piece.
  Points movedVolume(const RigidMotions& motions) const;

  /// Whether a triangle touches an edge of the rest shape at which two sides meet at an angle, and whether
  /// there is such a triangle.
  bool isAtCrease(int triangle) const { return at_crease_[static_cast<std::size_t>(triangle)]; }
  bool hasCreases() const { return has_creases_; }
  /// Whether a triangle fills a cut or touches one that does.
  bool isAtCut(int triangle) const;

  const Pinhole& camera() const { return camera_; }
  const Points& volumeVertices() const { return volume_vertices_; }
  /// Triangle and depth of every pixel.
  const RasterImage& image() const { return image_; }
  const TetTopology& volume() const { return volume_; }
  const MeshTopology& topology() const { return surface_; }

  /// The visible triangle at a measured point. @param tolerance distance along the ray [m].
  /// @return -1 if the moved surface is further away than the tolerance.
  int triangleAt(const Eigen::Vector3d& measured, double tolerance) const;
  /// The place in the rest body where the ray through a pixel meets a triangle's plane.
  MaterialPoint materialPoint(int triangle, const cv::Point2f& pixel) const;
  /// Change of a place's barycentric coordinates on a triangle's plane, per pixel to the right (first column)
  /// and downwards (second column).
  PlaceGradient placeGradient(const MaterialPoint& place, int triangle, const cv::Point2f& pixel) const;
  /// Pixels of this image per pixel of the image in which the gradient was taken, 2 by 2.
  Eigen::Matrix2f imageWarp(const MaterialPoint& place, const PlaceGradient& gradient) const;
  /// Outward unit normal of a triangle, camera frame. It is not smoothed: at a sharp edge, the mean normal of
  /// both sides would pull the surface off both sides.
  Eigen::Vector3d normal(int triangle) const;
  Eigen::Vector3d position(const MaterialPoint& place) const;

 private:
  /// The piece that moves a triangle.
  std::uint32_t pieceOfTriangle(int triangle) const {
    return tet_pieces_[binding_[surface_.triangles(triangle, 0)].tet];
  }
  Eigen::Matrix3d corners(int triangle) const;
  Eigen::Vector3d restPoint(int triangle, const cv::Point2f& pixel) const;
  Eigen::Vector4d barycentric(int tet, const Eigen::Vector3d& rest) const;

  TetTopology volume_;
  MeshTopology surface_;
  Faces faces_;
  std::vector<std::uint32_t> tet_pieces_, vertex_pieces_;  ///< piece of each tet and vertex of the volume
  std::vector<std::vector<int>> pieces_;                   ///< the volume's vertices of each
  std::vector<std::set<std::uint32_t>> surface_pieces_;    ///< see piecesOfSurface()
  std::vector<bool> at_cut_;     ///< #V of the surface: corner of a triangle that fills a cut
  std::vector<bool> at_crease_;  ///< of each triangle, see isAtCrease()
  bool has_creases_ = false;
  std::vector<MaterialPoint> binding_;
  std::vector<Eigen::Matrix3d> rest_inverse_;  ///< #T: maps offsets from a tet's first vertex to weights
  Pinhole camera_;
  Points volume_vertices_;
  Points vertices_;       ///< of the surface, at render()
  RigidMotions motions_;  ///< since render(); empty: not moved
  RasterImage image_;
};

}  // namespace softbody
