#pragma once

#include "scenes/stage.h"

/// The motions of the scenes. They use only the body's rest mesh: x is its length, z points up.
namespace softbody::virtual_camera {

Play stillPlay(const Stage& stage);
Play bendPlay(const Stage& stage);
Play twistPlay(const Stage& stage);
Play pushPlay(const Stage& stage);
Play pullPlay(const Stage& stage);
Play shakePlay(const Stage& stage);  ///< rigid; up to 1 m/s and 180 deg/s
Play rigidPlay(const Stage& stage);  ///< 5 cm and 30 deg away, and back
Play leavePlay(const Stage& stage);  ///< out of view to the left and back

}  // namespace softbody::virtual_camera
