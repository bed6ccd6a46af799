#pragma once

#include <functional>
#include <string>
#include <vector>

#include "softbody_virtual_camera/scenes/scene.h"

/// World frame of the scenes: origin on the table below the body, z up, the camera looks along +y and down.
namespace softbody::virtual_camera {

/// The set that all scenes share: a camera, half a metre from it a body in the air above a table, a wall.
struct Stage {
  Eigen::Isometry3d T_camera_world, T_camera_body;  ///< the body's frame where it begins
  std::vector<Actor> actors;                        ///< body, table, wall
};
Stage makeStage(const Body& body, std::uint64_t seed);

/// Something rigid that moves before the camera.
struct Prop {
  Actor actor;
  std::function<Eigen::Isometry3d(double t)> T_camera_prop;
};

/// What happens on the stage. If it ends as it begins, at rest, it starts over again.
struct Play {
  std::string name;
  double duration_s = 5.0;
  bool repeats = true;
  std::function<Eigen::Vector3d(const Eigen::Vector3d& rest, double t)> deformation;  ///< empty: rigid
  std::function<Eigen::Isometry3d(double t)> T_camera_body;                           ///< empty: it stays
  std::vector<Prop> props;
};
Scene perform(const Stage& stage, const Play& play);

}  // namespace softbody::virtual_camera
