#pragma once

#include <string>
#include <string_view>

#include "softbody_sim/io/tet_files.h"

namespace softbody {

/// The type number of a tet in VTK files.
constexpr int kVtkTetra = 10;

/// The text of a VTK unstructured grid, ascii. The orientation of the tets is as in the
/// file; their indices are checked. @param path for messages. @throw std::invalid_argument with file, cell
/// and error.
TetMesh parseVtu(const std::string& path, std::string_view text, Warnings* warnings);

}  // namespace softbody
