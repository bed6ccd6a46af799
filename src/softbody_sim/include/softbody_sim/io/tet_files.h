#pragma once

#include <string>

#include "softbody_common/types.h"
#include "softbody_sim/io/warnings.h"

namespace softbody {

/// Reads VTU (ascii), MSH 1 and 2 (ascii), TetGen (.node or .ele, the other one beside it) or VEG, in file
/// units. Skips cells other than tets, reorders tets of negative volume, drops tets without volume and unused
/// vertices.
/// @throw std::invalid_argument with the file, the line or element, and the error.
TetMesh readTetFile(const std::string& path, Warnings* warnings);

/// An ascii VTU with 17 significant digits: reading it gives the same numbers, bit for bit.
std::string vtuText(const TetMesh& mesh);

/// Writes it into a file. @throw std::runtime_error if the file cannot be written.
void writeVtu(const std::string& path, const TetMesh& mesh);

}  // namespace softbody
