#pragma once

#include "softbody_sim/io/tet_files.h"

namespace softbody {

/// Gmsh MSH 1, 2 and 4.1, ascii (Gmsh manual, "Gmsh mesh file formats"). Errors as readTetFile.
TetMesh readMsh(const std::string& path, Warnings* warnings);

}  // namespace softbody
