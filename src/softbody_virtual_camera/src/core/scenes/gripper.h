#pragma once

#include "softbody_virtual_camera/scenes/scene.h"

/// A parallel gripper at one end of a body. All points are in the body's frame [m].
namespace softbody::virtual_camera {

struct Gripper {
  Eigen::Isometry3d T_body_gripper;  ///< between the fingers, while it holds the body at rest
  std::array<double, 2> held_m;      ///< how far from the gripper's axis each side of the body is, along y
  TriangleMesh hand;                 ///< palm and arm, in the gripper's frame
  TriangleMesh finger;               ///< in its own frame
  Eigen::Vector3d inner_end;         ///< of the fingers, on the gripper's axis
};

struct Fingers {
  double width_m = 0.02;  ///< across the body
  double depth_m = 0.02;  ///< of the gripper's origin in the body, from its end
};

/// The fingers take the thinner side of the body. @param outward unit vector from the body to the arm.
Gripper makeGripper(const TriangleMesh& body, const Eigen::Vector3d& outward, const Fingers& fingers = {});

/// @param open 0: the fingers touch the body; 1: they are as far away as they go.
GripperState posed(const Gripper& gripper, double open);

}  // namespace softbody::virtual_camera
