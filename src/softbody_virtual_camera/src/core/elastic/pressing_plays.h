#pragma once

#include "scenes/stage.h"

namespace softbody::virtual_camera {

/// Scenes of an elastic body that a thing presses with a known force. Its weight is part of the rest shape.
/// What touches a thing sticks to it.
Play platesPlay(const Stage& stage);  ///< between two plates: at the front `table_plate`, at the back `plate`
Play pushHeldPlay(
    const Stage& stage);  ///< clamped at one end; a plate pushes the other one along x, in two steps
Play pressHeldPlay(const Stage& stage);  ///< clamped at both ends; a stamp presses the middle, in two steps

}  // namespace softbody::virtual_camera
