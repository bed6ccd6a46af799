#pragma once

#include "softbody_common/types.h"

namespace softbody {

/// The mesh with its holes covered: each open edge gets a triangle to the middle of the hole that it is on.
/// The caps may cross other triangles; they are for what only needs to know inside from outside.
TriangleMesh withHolesCovered(const TriangleMesh& mesh);

}  // namespace softbody
