#pragma once

#include <vector>

#include "softbody_common/geometry/types.h"

namespace softbody {

/// Shrinks a cage around the points that it encloses. Each vertex moves as close to the points below it as
/// possible, while all points stay behind the planes of its triangles.
/// @param cage closed, outward, without self-intersection. The result is too; only its vertices have moved.
TriangleMesh fitCage(const TriangleMesh& cage, const Points& points);

/// The indices of the points outside of a closed mesh, by its winding number.
std::vector<Eigen::Index> pointsBeyond(const Points& points, const TriangleMesh& mesh);

}  // namespace softbody
