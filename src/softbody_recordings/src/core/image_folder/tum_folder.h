#pragma once

#include <filesystem>
#include <string>

#include "softbody_recordings/image_folder/image_folder.h"

namespace softbody {

/// A folder of the TUM RGB-D benchmark (Sturm et al. 2012): rgb.txt and depth.txt list "stamp file", depth is
/// in 1/5000 m. The camera is the published colour camera of fr1.
/// @throw std::runtime_error naming file and line.
ImageFolder readTumFolder(const std::filesystem::path& directory);

std::string tumCameraWarning(const std::filesystem::path& directory);

}  // namespace softbody
