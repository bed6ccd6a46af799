#pragma once

#include <array>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "softbody_common/geometry/types.h"
#include "softbody_virtual_camera/bodies/body.h"
#include "softbody_virtual_camera/scenes/robot.h"
#include "softbody_virtual_camera/textures/texture.h"

namespace softbody::virtual_camera {

/// A visible thing of a scene.
struct Actor {
  TriangleMesh rest;              ///< [m]
  Texture texture;                ///< a function of the rest coordinates
  double texel_m = 0.4e-3;        ///< spacing at which the texture is sampled
  double crease_angle_rad = 0.7;  ///< edges with a larger angle at rest are creases
  UvTexture skin = {};            ///< replaces the texture on the triangles that it covers
  bool still = false;             ///< never moves in the camera's frame, so it is rendered once
  bool background =
      false;  ///< table or wall; other things than the body are occluders. Still things must be it
};

/// Distant lights. The shares of ambient, main and fill light add up to 1.
struct Lights {
  Eigen::Vector3d to_main = -Eigen::Vector3d::UnitZ();  ///< unit vector, in the optical frame
  Eigen::Vector3d to_fill = Eigen::Vector3d::Zero();    ///< the same; zero: no fill light
  float ambient = 0.40f, fill = 0.0f;
};

/// A gripper with two fingers. Its frame lies between them: z points at the body, y to the second finger. A
/// finger's frame is its centre.
struct GripperState {
  Eigen::Isometry3d T_camera_gripper = Eigen::Isometry3d::Identity();  ///< in the optical frame
  std::array<Eigen::Isometry3d, 2> T_camera_fingers;                   ///< likewise
  bool closed = false;                                                 ///< it holds the body
};

/// Where a thing is that holds or touches the body.
struct FramePose {
  std::string name;  ///< of its frame on tf
  Eigen::Isometry3d T_camera_frame;
};

/// What the body does to a thing, as a sensor there would say it: in the thing's frame, about its origin.
struct ContactWrench {
  std::string name;                                  ///< of the thing and of its frame
  Eigen::Vector3d force = Eigen::Vector3d::Zero();   ///< [N]
  Eigen::Vector3d torque = Eigen::Vector3d::Zero();  ///< [N m]
};

/// What a scene's solver made its body of.
struct TrueMaterial {
  Elasticity elasticity;  ///< with the density
  double volume_m3 = 0.0;

  double mass() const { return *elasticity.density_kg_m3 * volume_m3; }  ///< [kg]
};
/// As YAML: youngs_modulus_pa, poisson_ratio, density_kg_m3, damping, mass_kg.
std::string materialText(const TrueMaterial& material);

/// The gripper after a change of the camera's frame or of the scale.
GripperState transformed(const Eigen::Isometry3d& T, GripperState gripper);
GripperState scaled(GripperState gripper, double factor);

/// The external force on a part of the body's surface, in the colour optical frame.
struct SurfaceForce {
  std::string name;        ///< of what presses there
  Eigen::Vector3d place;   ///< mean, weighted by the sizes of the forces [m]
  Eigen::Vector3d normal;  ///< out of the body; unit
  Eigen::Vector3d force;   ///< on the body [N]
};

/// The forces after a change of the camera's frame.
std::vector<SurfaceForce> transformed(const Eigen::Isometry3d& T, std::vector<SurfaceForce> forces);

/// The poses of all things at one time.
struct SceneState {
  Eigen::Isometry3d T_camera_body = Eigen::Isometry3d::Identity();  ///< the body's frame in the optical frame
  std::vector<Points> vertices;  ///< per actor, in the colour optical frame [m]
  std::uint32_t revision = 0;    ///< of the body's topology
  std::optional<Eigen::Isometry3d> T_camera_tool = std::nullopt;
  std::optional<GripperState> gripper = std::nullopt;
  /// All on the body, besides its weight; none: not known.
  std::optional<std::vector<SurfaceForce>> forces = std::nullopt;
  std::vector<FramePose> frames = {};        ///< of things that hold or touch the body
  std::vector<ContactWrench> wrenches = {};  ///< on things with a sensor: the same ones at all times
  std::optional<Eigen::Isometry3d> T_camera_second = std::nullopt;  ///< frame of a second body
  std::vector<LinkPose> links = {};                                 ///< of a robot
  Lights lights = {};
  double brightness = 1.0;  ///< factor of the colour image: the lamp's power
  std::optional<Eigen::Isometry3d> T_world_camera = std::nullopt;  ///< only with a moving camera
};

/// A cut of the body, and the topology after it.
struct Edit {
  MeshTopology topology;
  std::vector<int>
      triangle_parents;  ///< #F: the triangle of revision 0 that it is part of; -1: it fills a cut
  TriangleMesh patch;    ///< surface swept by the blade's edge, in rest space [m]
};

/// What the virtual camera renders. The first actor is the soft body; its vertices are the truth.
struct Scene {
  std::string name;
  double duration_s = 0.0;  ///< of one run; the motion continues after it
  std::vector<Actor> actors;
  double color_noise = 1.0;  ///< factor of the colour camera's noise: its gain in low light
  std::size_t hands = 0;     ///< number of the last actors: hands, grippers and other things, but not a tool
  std::optional<std::size_t> second;     ///< the actor that is a second soft body with a truth of its own
  Robot robot;                           ///< empty: none
  std::optional<TrueMaterial> material;  ///< none: no solver made this scene
  bool has_weight = false;               ///< the body hangs in gravity, so the world must be known
  std::vector<Edit> edits;               ///< from revision 1 on; each is one stroke of the blade
  Eigen::Isometry3d T_camera_world = Eigen::Isometry3d::Identity();  ///< at the start; z is up
  std::function<SceneState(double t)> state;                         ///< t in seconds from the start
};

/// The same scene without hands and other things, so that nothing hides the body.
Scene withoutHands(Scene scene);

}  // namespace softbody::virtual_camera
