#include "softbody_tracking/ros/robot_reader.h"

#include <ros/package.h>

#include "robot/robot_mesh_file.h"

namespace softbody {

RobotDescription readRobot(const std::string& urdf, const std::string& folder) {
  const PackageFolder packages = [](const std::string& name) { return ros::package::getPath(name); };
  return readRobotDescription(
      urdf, [&](const std::string& name) { return readRobotMesh(robotFilePath(name, packages, folder)); });
}

}  // namespace softbody
