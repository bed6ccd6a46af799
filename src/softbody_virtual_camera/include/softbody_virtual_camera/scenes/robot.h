#pragma once

#include <array>
#include <string>
#include <vector>

#include "softbody_common/geometry/types.h"

namespace softbody::virtual_camera {

/// A box or a cylinder of a robot; its joint turns about z of the link's frame.
struct RobotLink {
  std::string name;                                                  ///< also its frame on tf
  Eigen::Isometry3d T_parent_joint = Eigen::Isometry3d::Identity();  ///< at the angle 0; of the first: unused
  Eigen::Isometry3d T_link_shape = Eigen::Isometry3d::Identity();
  Eigen::Vector3d box = Eigen::Vector3d::Zero();  ///< edge lengths [m]; zero: a cylinder along z of the shape
  double radius_m = 0.0, length_m = 0.0;          ///< of the cylinder
};

/// A chain: the parent of a link is the one before it.
using Robot = std::vector<RobotLink>;

/// Where a link is, in the optical frame.
struct LinkPose {
  std::string name;
  Eigen::Isometry3d T_camera_link;
};

/// The surface of a link, in its frame.
TriangleMesh linkMesh(const RobotLink& link);

/// All lengths multiplied by a factor.
Robot scaled(Robot robot, double factor);

/// The robot as URDF, with visual and collision shapes.
std::string urdfText(const Robot& robot);

}  // namespace softbody::virtual_camera
