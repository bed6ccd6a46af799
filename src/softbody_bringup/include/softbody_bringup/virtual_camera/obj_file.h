#pragma once

#include <string>

#include "softbody_common/types.h"

namespace softbody::virtual_camera {

/// Vertices in file order and triangles (larger faces as fans) of a Wavefront OBJ file in metres; the truth's
/// vertices are the file's, one by one. @throw std::invalid_argument with file and line.
TriangleMesh readObj(const std::string& path);

}  // namespace softbody::virtual_camera
