#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "softbody_common/types.h"
#include "softbody_virtual_camera/bodies/body.h"
#include "softbody_virtual_camera/textures/texture.h"

namespace softbody::virtual_camera {

/// Something to be seen.
struct Actor {
  TriangleMesh rest;              ///< [m]
  Texture texture;                ///< of the rest coordinates
  double texel_m = 0.4e-3;        ///< spacing at which the texture is sampled
  double crease_angle_rad = 0.7;  ///< edges that are sharper than this at rest are shaded as edges
  UvTexture skin = {};            ///< goes before the texture where it covers a triangle
  bool still = false;             ///< never moves in the camera's frame: rendered once
};

/// Where everything is at one instant.
struct SceneState {
  Eigen::Isometry3d T_camera_body = Eigen::Isometry3d::Identity();  ///< the body's frame in the optical frame
  std::vector<Points> vertices;  ///< one entry an actor, in the colour optical frame [m]
  std::uint32_t revision = 0;    ///< of the body's topology
  std::optional<Eigen::Isometry3d> T_camera_tool = std::nullopt;
  Eigen::Vector3d to_light = -Eigen::Vector3d::UnitZ();            ///< unit, in the optical frame
  std::optional<Eigen::Isometry3d> T_world_camera = std::nullopt;  ///< of a camera that moves
};

/// A cut of the body and its topology from then on.
struct Edit {
  MeshTopology topology;
  std::vector<int>
      triangle_parents;  ///< #F: the triangle of revision 0 that it is a part of, -1: fills a cut
  TriangleMesh patch;    ///< what the blade's edge passed through, in rest space [m]
};

/// What the virtual camera looks at. The first actor is the soft body, whose vertices are the truth.
struct Scene {
  std::string name;
  double duration_s = 0.0;  ///< one run; the motion goes on after it
  std::vector<Actor> actors;
  std::size_t hands = 0;    ///< the last so many actors: a hand, a finger; not a tool
  std::vector<Edit> edits;  ///< revision 1 and on, one stroke of a blade each
  Eigen::Isometry3d T_camera_world = Eigen::Isometry3d::Identity();  ///< before the camera moves; z is up
  std::function<SceneState(double t)> state;                         ///< t in seconds from 0
};

/// The same without its hands: how the body would be seen if nothing came before it.
Scene withoutHands(Scene scene);

/// Names of the scenes that makeScene knows.
std::vector<std::string> sceneNames();

/// The shipped object that a scene is made for: "doll" if its name says so, otherwise "sponge".
std::string objectOf(const std::string& scene);

/// @param body any one from 50 mm to 2 m long: its size and its longest axis fit the scene to it. @param seed
/// of the textures. @param tool_file YAML, read by scenes with a tool. @throw std::invalid_argument with the
/// known names if there is no such scene, or if the body does not fit.
Scene makeScene(const std::string& name, const Body& body, std::uint64_t seed,
                const std::string& tool_file = "");

}  // namespace softbody::virtual_camera
