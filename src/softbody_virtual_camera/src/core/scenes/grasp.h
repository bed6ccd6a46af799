#pragma once

#include "scenes/stage.h"

namespace softbody::virtual_camera {

/// A gripper takes one end, lifts the body, which hangs down at its other end, sets it down and lets go.
Play graspPlay(const Stage& stage);

}  // namespace softbody::virtual_camera
