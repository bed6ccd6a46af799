#pragma once

#include "cutting/split/split_surface.h"
#include "cutting/surface/wall_fill.h"

namespace softbody {

/// How the faces of a cut lie in the surface that is cut.
struct CoplanarFaces {
  std::size_t count = 0;                              ///< of the fill, that lie along the surface
  Eigen::Vector3d outward = Eigen::Vector3d::Zero();  ///< the surface's normal at the first of them
};

/// The fill's triangles whose middle is within a distance of a triangle that is nearly parallel: between them
/// would be a sheet without thickness.
CoplanarFaces findCoplanarFaces(const SplitSurface& surface, const WallFill& fill, const PatchFacets& facets,
                                double distance);

}  // namespace softbody
