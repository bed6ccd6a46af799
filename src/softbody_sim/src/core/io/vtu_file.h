#pragma once

#include <string>

#include "softbody_sim/io/tet_files.h"

namespace softbody {

/// The type number of a tet in VTK files.
constexpr int kVtkTetra = 10;

/// VTK unstructured grid, ascii. The orientation of the tets is as in the file; their indices are checked.
/// @throw std::invalid_argument with file, cell and error.
TetMesh readVtu(const std::string& path, Warnings* warnings);

}  // namespace softbody
