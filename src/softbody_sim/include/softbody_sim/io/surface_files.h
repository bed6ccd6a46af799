#pragma once

#include <string>

#include "softbody_common/types.h"
#include "softbody_sim/io/warnings.h"

namespace softbody {

/// The triangle mesh of a file, in file units. Polygons become triangle fans.
struct SurfaceFile {
  TriangleMesh mesh;           ///< vertices in file order
  Points texture_coordinates;  ///< empty, or 3 #F rows (u, v, 0), in the order of the triangles' corners
};

/// Reads OBJ, OFF, PLY (ascii, binary) or STL (ascii, binary). The file's extension selects the format.
/// @throw std::invalid_argument with the file, the line or element, and the error.
SurfaceFile readSurfaceFile(const std::string& path, Warnings* warnings);

/// Writes an OBJ with 17 significant digits. @throw std::runtime_error if the file cannot be written.
void writeObj(const std::string& path, const TriangleMesh& mesh,
              const Points& texture_coordinates = Points());

}  // namespace softbody
