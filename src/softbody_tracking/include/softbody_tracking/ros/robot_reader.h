#pragma once

#include <string>

#include "softbody_tracking/robot/robot_description.h"

namespace softbody {

/// A robot from a URDF, with its meshes. ROS finds the packages that it names.
/// @param folder where the relative paths of meshes start.
/// @throw std::invalid_argument as readRobotDescription.
RobotDescription readRobot(const std::string& urdf, const std::string& folder);

}  // namespace softbody
