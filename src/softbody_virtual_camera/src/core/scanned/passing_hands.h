#pragma once

#include <functional>
#include <vector>

#include "scanned/hand_held.h"
#include "softbody_virtual_camera/scenes/scene.h"

namespace softbody::virtual_camera {

/// A hand that moves in the world.
struct PassingHand {
  Actor actor;
  std::function<Eigen::Isometry3d(double t)> T_world_hand;
};

/// Three times a hand passes between the camera and the body, and once its fingers touch down beside the
/// body.
/// @param beside place on the table [m].
std::vector<PassingHand> passingHands(const CameraWay& way, const Eigen::Vector3d& beside);

}  // namespace softbody::virtual_camera
