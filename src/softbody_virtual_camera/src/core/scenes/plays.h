#pragma once

#include "scenes/stage.h"
#include "softbody_virtual_camera/scenes/tool.h"

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

/// A blade passes through the body. The topology changes when it is at its lowest; then it is withdrawn, and
/// the two pieces, which have touched so far, move apart.
Scene cutScene(const Stage& stage, const Tool& tool);
/// Likewise, but the blade goes in part of the way, and the slit opens.
Scene cutPartialScene(const Stage& stage, const Tool& tool);
/// Two cuts that cross, one after the other, and four pieces.
Scene cutCrossScene(const Stage& stage, const Tool& tool);

}  // namespace softbody::virtual_camera
