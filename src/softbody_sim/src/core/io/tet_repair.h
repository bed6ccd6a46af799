#pragma once

#include <string>
#include <vector>

#include "softbody_common/geometry/types.h"

namespace softbody {

/// Drops flat and repeated tets and unused vertices, and reorders tets of negative volume. @param path for
/// messages. @throw std::invalid_argument if no tet has a volume or a face belongs to more than two tets.
TetMesh repairTets(TetMesh mesh, const std::string& path, std::vector<std::string>* warnings);

}  // namespace softbody
