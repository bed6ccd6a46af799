#pragma once

#include <filesystem>
#include <opencv2/core/mat.hpp>
#include <string>

#include "softbody_common/files/input_file.h"

namespace softbody {

/// The image of an object's visual mesh: the first map_Kd of the material files that its OBJ names.
/// @param yaml the object YAML. @return empty if the mesh is no OBJ or names no image.
/// @throw std::invalid_argument if a file is missing, cannot be read, or is not in its allowed place.
std::filesystem::path textureImageOf(const std::filesystem::path& yaml, FileScope scope);

/// The pixels of that image (blue, green, red), to compare it with a camera's. Texture coordinates do not say
/// to which of several images they belong, so there must be only one.
/// @return empty if the mesh is no OBJ or names no image.
/// @throw std::invalid_argument as textureImageOf; if the file is no PNG or JPEG, is damaged, or has too many
/// pixels (see encoded_image.h); or if there are several images.
cv::Mat3b readObjectTexture(const std::filesystem::path& yaml, FileScope scope);

}  // namespace softbody
