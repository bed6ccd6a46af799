#pragma once

#include "softbody_common/types.h"

namespace softbody {

/// The mesh with its holes covered: a triangle joins each open edge with the centre of its hole. The caps may
/// intersect other triangles, so use them only for inside-outside tests.
TriangleMesh withHolesCovered(const TriangleMesh& mesh);

}  // namespace softbody
