#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "softbody_virtual_camera/textures/texture.h"
#include "softbody_virtual_camera/textures/uv_texture.h"

namespace softbody::virtual_camera {

/// How bodies are painted.
struct BodyPaint {
  Texture (*pattern)(std::uint64_t seed) = cellTexture;  ///< of what has no picture
  float contrast = 1.0f;                                 ///< of pattern and pictures; 0: one colour
};

/// The names of the kinds of paint: rich, weak, plain, sponge.
std::vector<std::string> textureNames();

/// rich: cellTexture(); weak: with a contrast of 0.1, like foam or cloth; plain: one colour; sponge:
/// spongeTexture(). @throw std::invalid_argument with the known names if the kind is unknown.
BodyPaint paintOf(const std::string& texture);

/// The texture of a body without a picture.
Texture textureOf(const BodyPaint& paint, std::uint64_t seed);

/// The colour of a plain body (r, g, b in 0..1): about the mean of cellTexture().
Eigen::Vector3f plainColor();

/// The texture with its contrast to plainColor() multiplied by a factor (0..1).
Texture withContrast(const Texture& texture, float contrast);

/// The same for pictures, with the contrast to the mean colour of each. Without contrast: no picture.
UvTexture withContrast(const UvTexture& skin, float contrast);

}  // namespace softbody::virtual_camera
