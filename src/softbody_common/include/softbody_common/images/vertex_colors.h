#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <vector>

#include "softbody_common/files/input_file.h"
#include "softbody_common/geometry/types.h"

namespace softbody {

/// Red, green, blue, 0 to 255, per vertex.
using VertexColors = std::vector<std::array<std::uint8_t, 3>>;

/// The colours in a mesh file, one per vertex in file order: the properties red, green and blue of a PLY, or
/// three numbers from 0 to 1 after the position in an OBJ. @return empty if not every vertex has a colour.
/// @throw std::invalid_argument if the file cannot be read.
VertexColors readVertexColors(const std::filesystem::path& mesh);

/// The same for the visual mesh of an object. @param yaml the object YAML.
/// @throw std::invalid_argument also if a file is not in its allowed place.
VertexColors readObjectColors(const std::filesystem::path& yaml, FileScope scope);

/// The colours of a topology's vertices: each has that of its parent. One without a parent (made by a cut)
/// has the mean of its neighbours. @param of_file as readVertexColors gives them.
/// @return empty if there are none. @throw std::invalid_argument if a parent is not in the file.
VertexColors colorsOfVertices(const MeshTopology& topology, const VertexColors& of_file);

}  // namespace softbody
