#pragma once

#include <string>

namespace softbody {

/// The object YAML that a user means: the file itself, or object.yaml in a folder.
/// @throw std::invalid_argument for a mesh and for a folder without object.yaml; it says what to give
/// instead.
std::string objectYamlAt(const std::string& given);

}  // namespace softbody
