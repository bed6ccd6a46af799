#pragma once

#include <filesystem>

#include "softbody_common/geometry/types.h"
#include "softbody_virtual_camera/textures/texture.h"

namespace softbody::virtual_camera {

/// Writes a body as an object whose picture is its texture: object.yaml, visual.obj, visual.mtl and
/// visual.png. A tracker that reads it knows what the body looks like.
/// @param folder with the files; an earlier one is replaced. @throw std::runtime_error if it cannot be
/// written.
void writePaintedObject(const TriangleMesh& rest, const Texture& texture,
                        const std::filesystem::path& folder);

}  // namespace softbody::virtual_camera
