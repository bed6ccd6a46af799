#pragma once

#include "softbody_sim/io/surface_files.h"

namespace softbody {

/// Wavefront OBJ: vertices, faces, texture coordinates and names of materials. Other statements are ignored
/// with a warning. Errors as readSurfaceFile.
SurfaceFile readObj(const std::string& path, Warnings* warnings);

}  // namespace softbody
