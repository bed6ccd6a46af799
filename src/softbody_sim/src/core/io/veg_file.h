#pragma once

#include <string>

#include "softbody_sim/io/tet_files.h"

namespace softbody {

/// VEG (Vega FEM user's manual, "Volumetric mesh file format"), without its materials: the object YAML has
/// those. The orientation of the tets is as in the file; their indices are checked. @throw
/// std::invalid_argument with file, line and error.
TetMesh readVeg(const std::string& path, Warnings* warnings);

}  // namespace softbody
