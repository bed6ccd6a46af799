#pragma once

#include <string>
#include <vector>

#include "softbody_virtual_camera/scenes/scene.h"

namespace softbody::virtual_camera {

/// The names of the camera motions: none, orbit.
std::vector<std::string> cameraMotionNames();

/// The same scene with a camera on a moving robot arm. `orbit` starts at rest at the scene's camera pose and
/// moves around the body: 25 degrees to both sides, 8 degrees up and down, and 10 % nearer and farther, at up
/// to 0.3 m/s for a distance of half a metre. The body is not always in the middle of the image.
/// @throw std::invalid_argument with the known names if the motion is unknown.
Scene withCameraMotion(const std::string& motion, const Scene& scene);

}  // namespace softbody::virtual_camera
