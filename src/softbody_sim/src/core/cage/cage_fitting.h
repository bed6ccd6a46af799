#pragma once

#include <vector>

#include "softbody_common/types.h"

namespace softbody {

/// Draws a cage in towards points that it encloses, as far as it keeps enclosing them: each vertex goes where
/// no point passes the planes of its triangles, as near to the points below it as that allows.
/// @param cage closed, outward, without self-intersection; so is the result, with the same triangles.
TriangleMesh fitCage(const TriangleMesh& cage, const Points& points);

/// The rows of the points that are outside of a closed mesh, by its winding number.
std::vector<Eigen::Index> pointsBeyond(const Points& points, const TriangleMesh& mesh);

}  // namespace softbody
