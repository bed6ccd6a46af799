#pragma once

#include "scenes/stage.h"

/// Scenes with another thing at the body, which leaves it. Places, turns, sizes and colours depend on the
/// seed. They end as they are after the motion.
namespace softbody::virtual_camera {

Play neighbourPlay(const Stage& stage);  ///< a box touches a side of the body, and is slid away after 1 s
Play twinPlay(const Stage& stage);   ///< an identical body lies 4 mm beside it, and is slid away after 1 s
Play stackPlay(const Stage& stage);  ///< a box lies on a third of it; it is lifted off and put down again

}  // namespace softbody::virtual_camera
