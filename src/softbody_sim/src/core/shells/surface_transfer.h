#pragma once

#include "surface_mesh/surface_repair.h"

namespace softbody {

/// A surface that was made from another one, with the parents of the vertices that stayed in place, in their
/// order, and with the texture of the nearest triangle. New vertices come last and have the parent -1. At a
/// seam of the texture, a new triangle across it is stretched.
WeldedSurface transferred(const WeldedSurface& from, const TriangleMesh& to);

}  // namespace softbody
