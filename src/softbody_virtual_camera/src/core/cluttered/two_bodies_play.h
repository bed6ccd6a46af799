#pragma once

#include "scenes/stage.h"

namespace softbody::virtual_camera {

Play twoBodiesPlay(const Stage& stage);  ///< a second body passes before the first one, and both bend

}  // namespace softbody::virtual_camera
