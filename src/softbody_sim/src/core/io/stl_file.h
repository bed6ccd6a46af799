#pragma once

#include <string>

#include "softbody_sim/io/surface_files.h"

namespace softbody {

/// STL, ascii or binary. Each facet has three vertices of its own. @throw std::invalid_argument with file and
/// error.
SurfaceFile readStl(const std::string& path);

}  // namespace softbody
