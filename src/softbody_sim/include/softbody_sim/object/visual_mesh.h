#pragma once

#include "softbody_common/geometry/types.h"
#include "softbody_sim/io/warnings.h"
#include "softbody_sim/object/object_description.h"

namespace softbody {

/// Loads and repairs the visual mesh only. The surface node needs no more of an object.
/// @throw std::invalid_argument with the file and the place in it.
MeshTopology loadVisualMesh(const ObjectDescription& description, Warnings* warnings);

}  // namespace softbody
