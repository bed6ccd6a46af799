#pragma once

#include "softbody_common/types.h"

namespace softbody {

/// A coarse, near uniform closed mesh around a fine one: edges collapse, shortest first, and each new vertex
/// lies outside of all triangles that it replaces (progressive hulls, Sander et al. 2000), so that the volume
/// only grows. Collapses that would fold the surface or leave needles are not made.
/// @param mesh closed 2-manifold, outward. @param vertices to stop at; more are left where no collapse keeps
/// enclosing.
TriangleMesh progressiveHull(const TriangleMesh& mesh, int vertices);

}  // namespace softbody
