#pragma once

#include <string>

#include "softbody_common/parameters.h"
#include "softbody_tracking/robot/robot_description.h"

namespace softbody {

/// A robot from a URDF, with its meshes. ROS finds the packages that it names.
/// @param folder where the relative paths of meshes start.
/// @throw std::invalid_argument as readRobotDescription.
RobotDescription readRobot(const std::string& urdf, const std::string& folder);

/// Reads `robot_deviation_m`, see robotSurfaces(). @throw std::invalid_argument as Parameters does.
double readRobotDeviation(Parameters& parameters);

}  // namespace softbody
