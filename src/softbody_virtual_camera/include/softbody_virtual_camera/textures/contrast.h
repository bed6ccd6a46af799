#pragma once

#include <string>
#include <vector>

#include "softbody_virtual_camera/textures/texture.h"
#include "softbody_virtual_camera/textures/uv_texture.h"

namespace softbody::virtual_camera {

/// The names of the kinds of texture: rich, weak, plain.
std::vector<std::string> textureNames();

/// Contrast of a kind of texture: 1 for rich, 0.1 for weak (like foam or cloth), 0 for plain (one colour).
/// @throw std::invalid_argument with the known names if the kind is unknown.
float contrastOf(const std::string& texture);

/// The colour of a plain body (r, g, b in 0..1): about the mean of cellTexture().
Eigen::Vector3f plainColor();

/// The texture with its contrast to plainColor() multiplied by a factor (0..1).
Texture withContrast(const Texture& texture, float contrast);

/// The same for pictures, with the contrast to the mean colour of each. Without contrast: no picture.
UvTexture withContrast(const UvTexture& skin, float contrast);

}  // namespace softbody::virtual_camera
