#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "softbody_virtual_camera/scenes/scene.h"
#include "textures/body_paint.h"

/// World frame of the scenes: origin on the table below the body, z up. The camera looks along +y and down.
namespace softbody::virtual_camera {

/// What all scenes share: a camera, a body above a table, and a wall.
struct Stage {
  Eigen::Isometry3d T_camera_world, T_camera_body;  ///< the body's frame at the start
  std::vector<Actor> actors;                        ///< body, table, wall
  Lights lights;
  Elasticity elasticity;  ///< of the body
  double gravity_m_s2 = 9.81;
  std::optional<Body> second;  ///< another body, for scenes with two
  BodyPaint paint;             ///< of the bodies
  std::uint64_t seed = 0;      ///< of what the play chooses by chance
};
constexpr double kNear_m = 0.5;  ///< usual distance between camera and body
/// @param paint of the body; a body of one colour has a second light, to show its shape.
/// Where the body is at the start. On the table it lies in its own soft shadow.
struct Place {
  double distance_m = kNear_m;  ///< between the camera and the middle of the body
  bool on_table = false;        ///< otherwise it hovers above it
  double clearance_m = 0.02;    ///< at least, between it and the table
};
Stage makeStage(const Body& body, std::uint64_t seed, const BodyPaint& paint, const Place& place);

/// A thing that moves in front of the camera.
struct Prop {
  Actor actor;
  std::function<Points(double t)> vertices;  ///< in the optical frame
};
Prop rigidProp(const Actor& actor, const std::function<Eigen::Isometry3d(double t)>& T_camera_prop);

/// The motion in a scene. A repeating motion must end at rest, as it begins.
struct Play {
  std::string name;
  double duration_s = 5.0;
  bool repeats = true;
  std::function<Eigen::Vector3d(const Eigen::Vector3d& rest, double t)> deformation;  ///< empty: rigid
  std::function<Points(double t)> shape;                      ///< of all vertices, instead of a deformation
  std::function<std::vector<SurfaceForce>(double t)> forces;  ///< in the body's frame
  std::function<Eigen::Isometry3d(double t)> T_camera_body;   ///< empty: the body does not move
  std::vector<Prop> props;
  std::function<GripperState(double t)> gripper;  ///< empty: none
  std::optional<TrueMaterial> material;           ///< of an elastic body
  bool has_weight = false;
  std::function<std::vector<FramePose>(double t)> frames;        ///< empty: none
  std::function<std::vector<ContactWrench>(double t)> wrenches;  ///< likewise
  std::function<double(double t)> brightness;                    ///< of the colour image; empty: 1
  double color_noise = 1.0;                                      ///< factor of the noise of colour
  /// Pose of the second body. It is the first prop. Empty: the scene has no second body.
  std::function<Eigen::Isometry3d(double t)> T_camera_second;
  Robot robot;  ///< its links are the first props; empty: none
  std::function<std::vector<Eigen::Isometry3d>(double t)> links;  ///< their poses in the optical frame
};
Scene perform(const Stage& stage, const Play& play);

}  // namespace softbody::virtual_camera
