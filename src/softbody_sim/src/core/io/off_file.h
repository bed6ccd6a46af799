#pragma once

#include "softbody_sim/io/surface_files.h"

namespace softbody {

/// Object File Format, ascii: OFF with the prefixes ST, C and N. Errors as readSurfaceFile.
SurfaceFile readOff(const std::string& path, Warnings* warnings);

}  // namespace softbody
