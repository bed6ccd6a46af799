#pragma once

#include "scenes/stage.h"

/// Scenes whose truth is an elastic body: its shape comes from a finite element solver, not from a formula.
namespace softbody::virtual_camera {

Play gripPlay(const Stage& stage);   ///< two fists hide both ends, lift, bend, twist and stretch the body
Play stampPlay(const Stage& stage);  ///< on the table, pressed by a stamp with a known force

}  // namespace softbody::virtual_camera
