#pragma once

#include <string>

#include "softbody_common/geometry/types.h"
#include "softbody_sim/io/warnings.h"

namespace softbody {

/// Reads VTU (ascii), MSH 1, 2 and 4.1 (ascii), TetGen (.node or .ele, the other one beside it), VEG or .tet,
/// in file units. Skips cells other than tets, takes the corners of quadratic tets, reorders tets of negative
/// volume, drops tets without volume and unused vertices.
/// @throw std::invalid_argument with the file, the line or element, and the error.
TetMesh readTetFile(const std::string& path, Warnings* warnings);

/// An ascii VTU with 17 significant digits: reading it gives the same numbers, bit for bit.
std::string vtuText(const TetMesh& mesh);

/// Writes it into a file. @throw std::runtime_error if the file cannot be written.
void writeVtu(const std::string& path, const TetMesh& mesh);

}  // namespace softbody
