#pragma once

#include <string>
#include <vector>

#include "softbody_common/types.h"

namespace softbody {

/// Sentences for the user about what was ignored, repaired or does not fit.
using Warnings = std::vector<std::string>;

/// A triangle mesh as a file has it, in file units. Polygons are fanned into triangles.
struct SurfaceFile {
  TriangleMesh mesh;           ///< vertices in file order
  Points texture_coordinates;  ///< empty, or 3 #F rows (u, v, 0), in the order of the triangles' corners
};

/// Reads OBJ, OFF, PLY (ascii, binary) or STL (ascii, binary), by the file's extension.
/// @throw std::invalid_argument with file, line or element, and what is wrong.
SurfaceFile readSurfaceFile(const std::string& path, Warnings* warnings);

/// Reads VTU (ascii), MSH 1 and 2 (ascii), TetGen (.node or .ele, the other beside it) or VEG, in file units.
/// Cells that are no tets are skipped, tets of negative volume reordered, tets without volume and unused
/// vertices dropped.
/// @throw std::invalid_argument with file, line or element, and what is wrong.
TetMesh readTetFile(const std::string& path, Warnings* warnings);

/// Writes an OBJ with 17 significant digits. @throw std::runtime_error if the file cannot be written.
void writeObj(const std::string& path, const TriangleMesh& mesh,
              const Points& texture_coordinates = Points());

/// Writes an ascii VTU with 17 significant digits, which reads back bit for bit.
/// @throw std::runtime_error if the file cannot be written.
void writeVtu(const std::string& path, const TetMesh& mesh);

}  // namespace softbody
