#pragma once

#include <optional>
#include <string>

#include "softbody_common/files/input_file.h"
#include "softbody_common/geometry/types.h"
#include "softbody_virtual_camera/textures/uv_texture.h"

namespace softbody::virtual_camera {

/// Of an elastic body, at small strains.
struct Elasticity {
  double youngs_modulus_pa = 2.0e4;
  double poisson_ratio = 0.2;                          ///< below 0.5
  std::optional<double> density_kg_m3 = std::nullopt;  ///< none: the scene chooses it
  double damping = 0.1;                                ///< share of the velocity that is lost in 1/30 s
};

/// A soft body at rest. Its vertices are those of the file, in the same order.
struct Body {
  TriangleMesh rest;
  UvTexture skin;  ///< triangles without an image have the solid texture
  Elasticity elasticity = {};
};

/// The body's topology at revision 0.
MeshTopology topologyOf(const Body& body);

/// Reads OBJ, PLY, STL or OFF. For OBJ also the images of its materials (mtllib, usemtl, map_Kd).
/// @param unit_m metres per file unit. @param warnings gets a sentence about each ignored part of the file.
/// @throw std::invalid_argument with file, line and what is wrong or missing.
Body readBody(const std::string& path, double unit_m, std::vector<std::string>* warnings,
              FileScope scope = FileScope::kOwnFolder);

}  // namespace softbody::virtual_camera
