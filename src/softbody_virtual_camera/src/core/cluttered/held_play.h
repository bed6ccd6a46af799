#pragma once

#include "scenes/stage.h"

namespace softbody::virtual_camera {

Play heldPlay(const Stage& stage);  ///< a fist holds one end from the first frame on, and lifts it

}  // namespace softbody::virtual_camera
