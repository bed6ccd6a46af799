#pragma once

#include "scenes/stage.h"

namespace softbody::virtual_camera {

Play clutterPlay(const Stage& stage);  ///< three things around it, and a box in front that hides half of it

}  // namespace softbody::virtual_camera
