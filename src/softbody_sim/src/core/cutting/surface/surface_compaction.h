#pragma once

#include "cutting/split/split_surface.h"
#include "cutting/surface/surface_cut.h"
#include "cutting/surface/surface_stitching.h"

namespace softbody {

/// A point as it is published, in Point32.
Eigen::Vector3d rounded(const Eigen::Vector3d& point);

/// What is published of a cut mesh: without the vertices and triangles that are no longer used, its pieces
/// numbered.
/// @param before the mesh that `surface` divides and `stitched` opens.
SurfaceCut compacted(const MeshTopology& before, const SplitSurface& surface,
                     const StitchedSurface& stitched);

}  // namespace softbody
