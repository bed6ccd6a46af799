#pragma once

#include "scenes/stage.h"

namespace softbody::virtual_camera {

/// Scenes of an elastic body that is clamped at one end, while a gripper moves the other one. Its weight is
/// part of the rest shape. Both say what the body does to them.
Play pullHeldPlay(const Stage& stage);   ///< pulls by 20 %, bends, and comes back
Play bendHeldPlay(const Stage& stage);   ///< bends upwards, in two steps
Play twistHeldPlay(const Stage& stage);  ///< twists, in two steps

}  // namespace softbody::virtual_camera
