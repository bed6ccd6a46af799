#pragma once

#include <filesystem>
#include <string>

#include "softbody_common/files/input_file.h"

namespace softbody {

/// The image of an object's visual mesh: the first map_Kd of the material files that its OBJ names.
/// @param yaml the object YAML. @return empty if the mesh is no OBJ or names no image.
/// @throw std::invalid_argument if a file is missing, cannot be read, or is not in its allowed place.
std::filesystem::path textureImageOf(const std::filesystem::path& yaml, FileScope scope);

}  // namespace softbody
