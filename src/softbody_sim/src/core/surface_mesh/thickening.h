#pragma once

#include <string>

#include "surface_mesh/surface_repair.h"

namespace softbody {

/// The closed surface of a sheet: two sides, half of the thickness away from the mesh along its vertex
/// normals, and walls along its open edges. The walls take their texture from the edge.
/// @param name of the mesh, for the message. @throw std::invalid_argument if the mesh has no open edges,
/// edges with more than two triangles, or no two sides.
WeldedSurface thickened(const WeldedSurface& sheet, double thickness_m, const std::string& name);

}  // namespace softbody
