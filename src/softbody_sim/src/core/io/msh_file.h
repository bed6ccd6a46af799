#pragma once

#include <string>

#include "softbody_sim/io/tet_files.h"

namespace softbody {

/// Gmsh MSH 1 and 2, ascii (Gmsh manual, "MSH file format version 1 (Legacy)" and "version 2 (Legacy)"). The
/// orientation of the tets is as in the file; their indices are checked. @throw std::invalid_argument with
/// file, line and error.
TetMesh readMsh(const std::string& path, Warnings* warnings);

}  // namespace softbody
