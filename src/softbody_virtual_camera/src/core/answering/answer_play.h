#pragma once

#include "scenes/stage.h"

namespace softbody::virtual_camera {

/// The body on the table answers a hand, which follows the play's `hand` commands. Without them, it takes one
/// end, lifts it, carries it aside and lets go. Times must not go back far, or all starts again.
Play answerPlay(const Stage& stage);

}  // namespace softbody::virtual_camera
