#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <functional>

namespace softbody::virtual_camera {

/// A solid texture: colour (r, g, b in 0..1) as a function of an actor's rest coordinates [m].
using Texture = std::function<Eigen::Vector3f(const Eigen::Vector3d& place)>;

/// Colourful cells (Worley 1996) of 18, 8 and 4 mm with dark pores: many corners, all different.
Texture cellTexture(std::uint64_t seed);

/// Yellow foam with round dark pores, 0.8 to 6 mm across, as a sponge for the kitchen has them.
Texture spongeTexture(std::uint64_t seed);

/// Pale wood: weak streaks along x, few corners.
Texture woodTexture(std::uint64_t seed);

/// Painted plaster: nearly uniform.
Texture plasterTexture(std::uint64_t seed);

/// Skin: nearly uniform.
Texture skinTexture();

}  // namespace softbody::virtual_camera
