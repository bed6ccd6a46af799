#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <set>
#include <vector>

#include "softbody_common/pinhole.h"
#include "softbody_common/rasterizer.h"
#include "softbody_common/types.h"

namespace softbody {

/// A rigid motion for each connected piece of the body; one as long as nothing is cut.
using RigidMotions = std::vector<Eigen::Isometry3d>;

/// Change of a MaterialPoint's barycentric coordinates per pixel, 4 by 2.
using PlaceGradient = Eigen::Matrix<double, 4, 2>;

/// The visual surface where the volume's state puts it, and what the camera sees of it.
class PredictedSurface {
 public:
  PredictedSurface(const TetTopology& volume, const MeshTopology& surface);

  /// Moves the surface with the volume's vertices (camera frame) and renders it.
  void update(const Pinhole& camera, const Points& volume_vertices);

  /// Moves each connected piece of the body since it was rendered; the image stays as it was.
  void move(const RigidMotions& motions);

  /// The piece that a place belongs to, and how many there are.
  std::uint32_t bodyOf(const MaterialPoint& place) const { return tet_bodies_[place.tet]; }
  std::size_t pieceCount() const { return pieces_.size(); }
  /// The volume's vertices of each.
  const std::vector<std::vector<int>>& pieces() const { return pieces_; }
  /// What the visual mesh shows of each, by MeshTopology::bodies: one or more, none where it lies inside of
  /// others' tets.
  const std::vector<std::set<std::uint32_t>>& surfaceBodies() const { return surface_bodies_; }
  /// Where they are, piece by piece.
  std::vector<Points> pieceVertices() const;
  /// Every piece's vertices moved by its motion.
  Points movedVolume(const RigidMotions& motions) const;

  /// Whether a triangle fills a cut or borders on one.
  bool isAtCut(int triangle) const;

  const Pinhole& camera() const { return camera_; }
  const Points& volumeVertices() const { return volume_vertices_; }
  /// Which triangle lies at a pixel, and how deep.
  const RasterImage& image() const { return image_; }
  const TetTopology& volume() const { return volume_; }
  const MeshTopology& topology() const { return surface_; }

  /// The visible triangle at a point measured in the frame, -1 where the surface as moved is further from it
  /// than the tolerance along the ray [m].
  int triangleAt(const Eigen::Vector3d& measured, double tolerance) const;
  /// The place in the rest body that a ray through (u, v) meets, on a triangle's plane.
  MaterialPoint materialPoint(int triangle, const cv::Point2f& pixel) const;
  /// How a place's barycentric coordinates change per pixel to the right (first column) and downwards, on a
  /// triangle's plane.
  PlaceGradient placeGradient(const MaterialPoint& place, int triangle, const cv::Point2f& pixel) const;
  /// Pixels here per pixel of the image in which the gradient was taken.
  Eigen::Matrix2f imageWarp(const MaterialPoint& place, const PlaceGradient& gradient) const;
  /// Outward unit normal of a triangle, camera frame. Not smoothed: near a sharp edge a mean of both sides'
  /// normals would pull the surface off either.
  Eigen::Vector3d normal(int triangle) const;
  Eigen::Vector3d position(const MaterialPoint& place) const;

 private:
  /// The piece that a triangle follows.
  std::uint32_t tetBodyOf(int triangle) const {
    return tet_bodies_[binding_[surface_.triangles(triangle, 0)].tet];
  }
  Eigen::Matrix3d corners(int triangle) const;
  Eigen::Vector3d restPoint(int triangle, const cv::Point2f& pixel) const;
  Eigen::Vector4d barycentric(int tet, const Eigen::Vector3d& rest) const;

  TetTopology volume_;
  MeshTopology surface_;
  Faces faces_;
  std::vector<std::uint32_t> tet_bodies_, vertex_bodies_;  ///< connected piece, #T and #V of the volume
  std::vector<std::vector<int>> pieces_;                   ///< vertices of each
  std::vector<std::set<std::uint32_t>> surface_bodies_;    ///< of each
  std::vector<bool> at_cut_;  ///< #V of the surface: a corner of a triangle that fills a cut
  std::vector<MaterialPoint> binding_;
  std::vector<Eigen::Matrix3d> rest_inverse_;  ///< #T: takes offsets from a tet's first vertex to weights
  Pinhole camera_;
  Points volume_vertices_;
  Points vertices_;       ///< of the surface, as rendered
  RigidMotions motions_;  ///< since then; none: not moved
  RasterImage image_;
};

}  // namespace softbody
