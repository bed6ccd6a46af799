#pragma once

#include "scenes/stage.h"

namespace softbody::virtual_camera {

Play armPlay(const Stage& stage);  ///< a robot arm passes before the body, which bends

}  // namespace softbody::virtual_camera
