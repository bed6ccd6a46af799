#pragma once

#include "softbody_sim/io/surface_files.h"

namespace softbody {

/// Polygon File Format, ascii or binary of both byte orders, with texture coordinates of vertices (s, t or u,
/// v) or of faces (texcoord). Errors as readSurfaceFile.
SurfaceFile readPly(const std::string& path, Warnings* warnings);

}  // namespace softbody
