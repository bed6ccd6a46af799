#pragma once

#include "scenes/stage.h"

/// The motions of the scenes with a hand or a finger.
namespace softbody::virtual_camera {

Play pressPlay(const Stage& stage);    ///< a finger presses from above
Play occludePlay(const Stage& stage);  ///< a hand hides 40 % for 2 s while the body bends
Play touchPlay(const Stage& stage);    ///< a hand takes one end, bends the body and lets go
Play squeezePlay(const Stage& stage);  ///< two hands make the body shorter by 30 %

}  // namespace softbody::virtual_camera
