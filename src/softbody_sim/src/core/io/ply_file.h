#pragma once

#include <string>

#include "softbody_sim/io/surface_files.h"

namespace softbody {

/// PLY, ascii or binary (Turk 1994, "The PLY Polygon File Format"). Face indices are checked.
/// @throw std::invalid_argument with file, element and error.
SurfaceFile readPly(const std::string& path);

}  // namespace softbody
