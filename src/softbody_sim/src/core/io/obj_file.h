#pragma once

#include <string>

#include "softbody_sim/io/surface_files.h"

namespace softbody {

/// Wavefront OBJ. Face indices are checked. @throw std::invalid_argument with file, line and error.
SurfaceFile readObj(const std::string& path, Warnings* warnings);

}  // namespace softbody
