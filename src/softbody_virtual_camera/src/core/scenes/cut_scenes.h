#pragma once

#include "scenes/stage.h"
#include "scenes/tool.h"

/// The scenes in which a blade cuts the body.
namespace softbody::virtual_camera {

/// A blade cuts the body in two. The topology changes when the blade is at its lowest point. Then the blade
/// is withdrawn, and the two pieces move apart.
Scene cutScene(const Stage& stage, const Tool& tool);
/// The blade cuts only partly through the body, and the slit opens.
Scene cutPartialScene(const Stage& stage, const Tool& tool);
/// Two crossing cuts, one after the other, give four pieces.
Scene cutCrossScene(const Stage& stage, const Tool& tool);

}  // namespace softbody::virtual_camera
