#pragma once

#include <optional>

#include "softbody_common/geometry/types.h"

namespace softbody::scanning {

/// The part of a mesh that is the object. With a point on it or in it: the one whose distance is the least
/// part of its size, so that a click beside a thing never means a speck. Without: the one that encloses the
/// most for its distance from the vertical line through the origin. Nothing if no part encloses a volume.
/// @param at in the mesh's frame [m]. @throw std::invalid_argument if every part is farther from the point
/// than half its size: nothing is there.
std::optional<TriangleMesh> objectPart(const TriangleMesh& mesh, const std::optional<Eigen::Vector3d>& at);

/// Smallest box around a mesh.
Eigen::AlignedBox3d boxOf(const TriangleMesh& mesh);

}  // namespace softbody::scanning
