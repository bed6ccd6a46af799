#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <string>
#include <vector>

#include "softbody_common/geometry/types.h"

namespace softbody {

/// The surface that a user sees, carried by the tets. It chooses the vertices of the tets that hold what lies
/// in a box.
class BodySurface {
 public:
  /// Without a surface: only the tets' own vertices are looked at.
  BodySurface() = default;
  /// @param visual, volume the uncut body.
  BodySurface(MeshTopology visual, TetTopology volume);

  /// The same surface in an edited volume. @throw std::invalid_argument if the volume has no tets.
  BodySurface in(const TetTopology& volume) const;
  /// Whether in() would give the same.
  bool isIn(const TetTopology& volume) const;

  /// The vertices of the tets to hold, ascending: those in the box. If they carry less than half of a surface
  /// point in the box, all vertices that carry it are held, too. So a box that is smaller than a tet holds
  /// what is seen in it. @param vertices #V by 3, of the volume of in() [m]. @param T_box_points from their
  /// frame to the box's.
  std::vector<int> verticesToHold(const Eigen::AlignedBox3d& box, const Eigen::Isometry3d& T_box_points,
                                  const Points& vertices) const;

  /// verticesToHold() of a box in rest space. @param what the box is, for the error.
  /// @throw std::invalid_argument if the box holds no vertex. The error names what is nearest to the box.
  std::vector<int> verticesAtRest(const std::string& what, const Eigen::AlignedBox3d& box,
                                  const Points& rest_vertices) const;

  /// What is nearest to a box that holds nothing, as the end of a sentence. Parameters as verticesToHold().
  std::string nearestTo(const Eigen::AlignedBox3d& box, const Eigen::Isometry3d& T_box_points,
                        const Points& vertices) const;

 private:
  MeshTopology visual_;                               ///< uncut
  TetTopology volume_;                                ///< that places_ are in
  std::optional<std::vector<MaterialPoint>> places_;  ///< of the visual vertices; empty: not found yet
};

}  // namespace softbody
