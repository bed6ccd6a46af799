#pragma once

#include <string>

#include "softbody_sim/object/material.h"

namespace softbody {

/// An object YAML with other values of its material; all else stays as the user wrote it, with comments.
/// Regions keep their boxes and get their values; a value that the YAML does not have is added. Without
/// youngs_modulus_std_pa in the material, it goes.
/// @param text of the YAML. @param path for messages.
/// @throw std::invalid_argument if the text is not an object YAML with these regions.
std::string withMaterial(const std::string& text, const Material& material, const std::string& path);

}  // namespace softbody
