#pragma once

#include <std_msgs/Header.h>

#include <functional>
#include <set>
#include <string>
#include <vector>

#include "softbody_recordings/ros/bag_transforms.h"
#include "softbody_tracking/robot/robot_surfaces.h"

namespace softbody {

/// The links of a robot where a bag's tf says that they are.
class RecordedRobot {
 public:
  using Warn = std::function<void(const std::string&)>;

  /// @param file URDF. @throw std::invalid_argument as readRobot.
  RecordedRobot(const std::string& file, double deviation_m, Warn warn);

  /// The links in the camera's frame. Warns once of each link that tf does not know.
  /// @param header of the colour image.
  std::vector<KnownSurface> at(const std_msgs::Header& header, const BagTransforms& transforms);

 private:
  RobotDescription robot_;
  double deviation_m_;
  Warn warn_;
  std::set<std::string> absent_;  ///< links that a warning has named
};

}  // namespace softbody
