#pragma once

#include <string>

#include "softbody_common/types.h"
#include "softbody_virtual_camera/textures/uv_texture.h"

namespace softbody::virtual_camera {

/// A soft body at rest. The truth's vertices are the file's, one by one.
struct Body {
  TriangleMesh rest;
  UvTexture skin;  ///< where it covers nothing, the body is solid through and through
};

/// The body's topology of revision 0.
MeshTopology topologyOf(const Body& body);

/// Reads OBJ, PLY, STL or OFF; of an OBJ also the pictures that its materials name (mtllib, usemtl, map_Kd).
/// @param unit_m metres per file unit. @param warnings gets what was ignored in the file.
/// @throw std::invalid_argument with file, line and what is wrong or missing.
Body readBody(const std::string& path, double unit_m, std::vector<std::string>* warnings);

}  // namespace softbody::virtual_camera
