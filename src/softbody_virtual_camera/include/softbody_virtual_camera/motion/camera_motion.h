#pragma once

#include <string>
#include <vector>

#include "softbody_virtual_camera/scenes/scene.h"

namespace softbody::virtual_camera {

/// Names of the motions that withCameraMotion knows: none, orbit.
std::vector<std::string> cameraMotionNames();

/// The same scene before a camera that a robot's arm moves. `orbit` starts at rest at the scene's own place
/// and goes around the body: 25 degrees to both sides and 8 up and down, from half a metre 5 cm farther away
/// and nearer (the lengths scale with the distance), not always looking at the middle, at up to 0.3 m/s.
/// @throw std::invalid_argument with the known names if there is no such motion.
Scene withCameraMotion(const std::string& motion, const Scene& scene);

}  // namespace softbody::virtual_camera
