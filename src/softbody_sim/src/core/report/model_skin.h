#pragma once

#include <array>
#include <filesystem>
#include <string>

#include "softbody_sim/io/warnings.h"

namespace softbody {

/// The files that writeSkin may write.
constexpr std::array<const char*, 3> kSkinFiles{"visual.mtl", "visual.png", "visual.jpg"};

/// Copies the picture of a mesh file into a folder as visual.png or visual.jpg, with visual.mtl that names
/// it. Of several pictures, the one on most triangles is kept, with a warning.
/// @return the name of the material file; empty if there is no picture that can be used.
std::string writeSkin(const std::string& mesh, const std::filesystem::path& folder, Warnings* warnings);

}  // namespace softbody
