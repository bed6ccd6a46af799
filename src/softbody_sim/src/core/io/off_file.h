#pragma once

#include <string>

#include "softbody_sim/io/surface_files.h"

namespace softbody {

/// Object File Format, ascii. Face indices are checked. @throw std::invalid_argument with file, line and
/// error.
SurfaceFile readOff(const std::string& path);

}  // namespace softbody
