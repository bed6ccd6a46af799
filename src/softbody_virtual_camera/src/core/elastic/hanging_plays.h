#pragma once

#include "scenes/stage.h"

namespace softbody::virtual_camera {

/// Scenes of an elastic body that is clamped at one end. A support carries it, so that it begins in its rest
/// shape. Unless the density is given, it is chosen for the body.
/// @throw std::invalid_argument if the body sags onto the table.
Play sagPlay(const Stage& stage);    ///< the support sinks slowly, and the body hangs still
Play swingPlay(const Stage& stage);  ///< the support falls away, and the body swings until it hangs still

}  // namespace softbody::virtual_camera
