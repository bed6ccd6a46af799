#pragma once

#include <vector>

#include "softbody_common/geometry/types.h"

namespace softbody::bench {

/// The true shapes of a body that two hands bend. Each hand holds a quarter of the half length and moves it
/// rigidly. What lies between the hands is in balance: stable neo-Hookean finite elements, on tets eight
/// times as fine as the body's. So the truth is one that forces on the held ends alone explain.
/// @param curvature of the axis in the last frame [1/m]; it grows smoothly from 0.
/// @return per frame the places of the body's vertices [m]. The middle of the axis is the origin in x and z.
/// @throw std::runtime_error if a frame finds no balance.
std::vector<Points> heldShapes(const TetTopology& body, double curvature, int frames);

}  // namespace softbody::bench
