#pragma once

#include "softbody_common/geometry/types.h"

namespace softbody {

/// A coarse, nearly uniform closed mesh around a fine one (progressive hulls, Sander et al. 2000). Edges
/// collapse, shortest first. Each new vertex lies outside of all triangles that it replaces, so the volume
/// only grows. Collapses that would fold the surface or make needles are skipped.
/// @param mesh closed 2-manifold, outward. @param vertices wanted number. More are left if no further
/// collapse keeps the mesh enclosed.
TriangleMesh progressiveHull(const TriangleMesh& mesh, int vertices);

}  // namespace softbody
