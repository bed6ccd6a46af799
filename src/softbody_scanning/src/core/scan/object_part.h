#pragma once

#include <optional>

#include "softbody_common/types.h"

namespace softbody::scanning {

/// The part of a mesh that is the object: the one that encloses the most for its distance from the vertical
/// line through the origin. Nothing if no part encloses a volume.
std::optional<TriangleMesh> objectPart(const TriangleMesh& mesh);

/// Smallest box around a mesh.
Eigen::AlignedBox3d boxOf(const TriangleMesh& mesh);

}  // namespace softbody::scanning
