#pragma once

#include <ros/ros.h>

#include <memory>
#include <set>
#include <string>
#include <vector>

#include "nodes/output_frame.h"
#include "softbody_tracking/robot/robot_surfaces.h"
#include "softbody_tracking/ros/node_options.h"

namespace softbody {

/// The links of a robot where tf says that they are.
class RobotLinks {
 public:
  /// @param frame must outlive the links.
  RobotLinks(RobotDescription robot, double deviation_m, const OutputFrame* frame);

  /// The links in the camera's frame. Warns once of each link that tf does not know.
  /// @param header of the colour image.
  std::vector<KnownSurface> at(const RgbdFrame& frame, const std_msgs::Header& header);

 private:
  std::optional<Eigen::Isometry3d> poseOf(const std::string& link, const RgbdFrame& frame,
                                          const std_msgs::Header& header);

  RobotDescription robot_;
  double deviation_m_;
  const OutputFrame* frame_;
  std::set<std::string> absent_;  ///< links that a warning has named
};

/// @return nullptr: no robot.
/// @throw std::invalid_argument if there is no parameter with the URDF, or the URDF cannot be read.
std::unique_ptr<RobotLinks> makeRobotLinks(const ros::NodeHandle& handle, const RobotOptions& options,
                                           const OutputFrame* frame);

}  // namespace softbody
