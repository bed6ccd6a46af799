#pragma once

#include "stage.h"

/// The scenes' plays. They know of the body only what its rest mesh says: x is its length, z points up.
namespace softbody::virtual_camera {

Play stillPlay(const Stage& stage);
Play bendPlay(const Stage& stage);
Play twistPlay(const Stage& stage);
Play pushPlay(const Stage& stage);
Play pullPlay(const Stage& stage);
Play shakePlay(const Stage& stage);    ///< rigid; up to 1 m/s and 180 deg/s
Play leavePlay(const Stage& stage);    ///< out of view to the left and back
Play pressPlay(const Stage& stage);    ///< by a finger from above
Play occludePlay(const Stage& stage);  ///< a hand hides 40 % for 2 s while the body bends

}  // namespace softbody::virtual_camera
