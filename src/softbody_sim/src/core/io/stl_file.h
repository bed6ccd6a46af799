#pragma once

#include "softbody_sim/io/surface_files.h"

namespace softbody {

/// STL, ascii or binary. Each facet has its own vertices. Errors as readSurfaceFile.
SurfaceFile readStl(const std::string& path, Warnings* warnings);

}  // namespace softbody
