#pragma once

#include "cutting/fill/cut_fill.h"
#include "cutting/split/split_surface.h"

namespace softbody {

/// The faces of a cut that coincide with the surface of the body.
struct CoplanarFaces {
  std::size_t count = 0;                              ///< number of such triangles of the fill
  Eigen::Vector3d outward = Eigen::Vector3d::Zero();  ///< normal of the surface at the first one
};

/// The triangles of the fill that are nearly parallel and close to a triangle of the surface: the layer
/// between them would have no thickness.
CoplanarFaces findCoplanarFaces(const SplitSurface& surface, const CutFill& fill, const PatchFacets& facets,
                                double distance);

}  // namespace softbody
