#pragma once

#include <Eigen/Geometry>
#include <functional>
#include <optional>
#include <vector>

#include "softbody_tracking/known/known_surface.h"
#include "softbody_tracking/robot/robot_description.h"

namespace softbody {

/// T_camera_link of a link; nothing: it is not known, and the link is left out.
using LinkPose = std::function<std::optional<Eigen::Isometry3d>(const std::string& link)>;

/// The links as known surfaces, in the camera's frame, without those that hold the camera.
/// @param deviation_m standard deviation of a link's place: joints, and the camera's calibration.
std::vector<KnownSurface> robotSurfaces(const RobotDescription& robot, const LinkPose& pose,
                                        double deviation_m);

}  // namespace softbody
