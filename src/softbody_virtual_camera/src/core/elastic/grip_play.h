#pragma once

#include "scenes/stage.h"

namespace softbody::virtual_camera {

/// Two fists hide both ends, lift, bend, twist and stretch the body. The truth is an elastic body.
Play gripPlay(const Stage& stage);

}  // namespace softbody::virtual_camera
