#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <cstdint>
#include <set>
#include <vector>

#include "softbody_common/geometry/types.h"
#include "softbody_common/images/rasterizer.h"

namespace softbody {

/// A rigid motion for each connected piece of the body; an uncut body has one piece.
using RigidMotions = std::vector<Eigen::Isometry3d>;

/// The body's volume and its visual surface at rest, and all that follows from them. It does not change from
/// frame to frame, so predictions share it.
class SurfaceModel {
 public:
  SurfaceModel(const TetTopology& volume, const MeshTopology& surface);

  const TetTopology& volume() const { return volume_; }
  const MeshTopology& surface() const { return surface_; }
  /// The surface's faces that a camera can see.
  Faces faces() const { return faces_; }

  /// The piece that a place belongs to, the piece that moves a triangle, and the number of pieces.
  std::uint32_t pieceOf(const MaterialPoint& place) const { return tet_pieces_[place.tet]; }
  std::uint32_t pieceOfTriangle(int triangle) const {
    return pieceOf(binding_[surface_.triangles(triangle, 0)]);
  }
  std::size_t pieceCount() const { return pieces_.size(); }
  /// Indices of the volume's vertices, for each piece.
  const std::vector<std::vector<int>>& pieces() const { return pieces_; }
  /// For each piece its numbers in MeshTopology::triangle_pieces: one or more; empty if no part of the visual
  /// mesh follows the piece.
  const std::vector<std::set<std::uint32_t>>& piecesOfSurface() const { return surface_pieces_; }

  /// Whether a triangle touches an edge of the rest shape at which two sides meet at an angle, and whether
  /// there is such a triangle.
  bool isAtCrease(int triangle) const { return at_crease_[static_cast<std::size_t>(triangle)]; }
  bool hasCreases() const { return has_creases_; }
  /// Whether a triangle fills a cut or touches one that does.
  bool isAtCut(int triangle) const;

  /// The surface's vertices for these of the volume [m].
  Points surfaceVertices(const Points& volume_vertices) const;
  /// The volume's vertices [m], each moved by the motion of its piece.
  Points moved(const Points& volume_vertices, const RigidMotions& motions) const;

  /// The place of a point of the rest shape on a triangle's plane [m].
  MaterialPoint placeOf(const Eigen::Vector3d& rest, int triangle) const;
  /// Weights of a tet's corners at a point of the rest shape [m]; they sum to 1.
  Eigen::Vector4d barycentric(int tet, const Eigen::Vector3d& rest) const;

 private:
  TetTopology volume_;
  MeshTopology surface_;
  Faces faces_;
  std::vector<std::uint32_t> tet_pieces_, vertex_pieces_;  ///< piece of each tet and vertex of the volume
  std::vector<std::vector<int>> pieces_;                   ///< the volume's vertices of each
  std::vector<std::set<std::uint32_t>> surface_pieces_;    ///< see piecesOfSurface()
  std::vector<bool> at_cut_;     ///< #V of the surface: corner of a triangle that fills a cut
  std::vector<bool> at_crease_;  ///< of each triangle, see isAtCrease()
  bool has_creases_;
  std::vector<MaterialPoint> binding_;         ///< of each vertex of the surface
  std::vector<Eigen::Matrix3d> rest_inverse_;  ///< #T: maps offsets from a tet's first vertex to weights
};

}  // namespace softbody
