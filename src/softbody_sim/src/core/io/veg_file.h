#pragma once

#include "softbody_sim/io/tet_files.h"

namespace softbody {

/// VEG (Vega FEM user's manual, "Volumetric mesh file format"), without its materials: the object YAML has
/// those. Errors as readTetFile.
TetMesh readVeg(const std::string& path, Warnings* warnings);

}  // namespace softbody
