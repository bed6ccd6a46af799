#pragma once

#include "cutting/split/split_surface.h"
#include "cutting/surface/surface_cut.h"
#include "cutting/surface/surface_stitching.h"

namespace softbody {

/// The published form of a cut mesh: without unused vertices and triangles, with numbered pieces.
/// @param before the mesh of which `surface` is the divided and `stitched` the opened form.
SurfaceCut compacted(const MeshTopology& before, const SplitSurface& surface,
                     const StitchedSurface& stitched);

}  // namespace softbody
