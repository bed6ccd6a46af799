#pragma once

#include "cutting/patch/patch_intersector.h"
#include "softbody_common/geometry/tet_locator.h"

namespace softbody {

/// The uncut visual mesh as a solid, at rest.
class RestSolid {
 public:
  explicit RestSolid(const MeshTopology& uncut);

  bool contains(const Eigen::Vector3d& point) const;
  /// Crossings of a segment with the surface, in ascending t.
  std::vector<PatchHit> crossings(const Eigen::Vector3d& a, const Eigen::Vector3d& b) const {
    return surface_.hits(a, b);
  }
  /// Whether a segment crosses the surface.
  bool meets(const Eigen::Vector3d& a, const Eigen::Vector3d& b) const { return !crossings(a, b).empty(); }

 private:
  PatchIntersector surface_;
  Eigen::Vector3d outside_;  ///< a point outside of the solid
};

/// Maps points from the deformed body to its rest shape. Outside of the body the map continues rigidly from
/// the nearest tet. Points in the gap of an open cut map to a wall of the cut.
class RestMap {
 public:
  /// Keeps references to `volume` and `solid`. @throw std::invalid_argument if a deformed tet has no volume.
  RestMap(const TetTopology& volume, const Points& deformed, const RestSolid& solid);

  Points toRest(const Points& points) const;

 private:
  Eigen::Vector3d toRest(const Eigen::Vector3d& point) const;

  const TetTopology& volume_;
  const RestSolid& solid_;
  Points deformed_;
  TetLocator locator_;
};

}  // namespace softbody
