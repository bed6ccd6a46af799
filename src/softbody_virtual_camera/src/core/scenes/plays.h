#pragma once

#include "scenes/stage.h"
#include "softbody_virtual_camera/scenes/tool.h"

/// The motions of the scenes. They use only the body's rest mesh: x is its length, z points up.
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

/// A blade cuts the body in two. The topology changes when the blade is at its lowest point. Then the blade
/// is withdrawn, and the two pieces move apart.
Scene cutScene(const Stage& stage, const Tool& tool);
/// The blade cuts only partly through the body, and the slit opens.
Scene cutPartialScene(const Stage& stage, const Tool& tool);
/// Two crossing cuts, one after the other, give four pieces.
Scene cutCrossScene(const Stage& stage, const Tool& tool);

}  // namespace softbody::virtual_camera
