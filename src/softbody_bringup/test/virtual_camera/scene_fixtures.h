#pragma once

#include <Eigen/Dense>

#include "softbody_bringup/virtual_camera/scene.h"
#include "softbody_bringup/virtual_camera/shapes.h"

namespace softbody::virtual_camera {

/// A shipped object, "sponge" or "doll".
inline Body shippedBody(const std::string& name) {
  std::vector<std::string> warnings;
  return readBody(std::string(CONFIG_DIR) + "/" + name + ".obj", 1.0, &warnings);
}

inline Texture uniformTexture(float level) {
  return [level](const Eigen::Vector3d&) { return Eigen::Vector3f(level, level, level); };
}

/// A rectangle of the given half sizes in its own plane z = 0, its front towards -z.
inline TriangleMesh rectangleMesh(double half_x, double half_y) {
  TriangleMesh mesh{Points(4, 3), Triangles(2, 3)};
  mesh.vertices << -half_x, -half_y, 0, half_x, -half_y, 0, half_x, half_y, 0, -half_x, half_y, 0;
  mesh.triangles << 0, 2, 1, 0, 3, 2;
  return mesh;
}

/// Actors that stand still at these poses in the camera's frame.
inline Scene stillScene(std::vector<Actor> actors, const std::vector<Eigen::Isometry3d>& poses) {
  Scene scene;
  scene.name = "still";
  scene.duration_s = 1.0;
  SceneState state{poses.at(0), {}};
  for (std::size_t i = 0; i < actors.size(); ++i)
    state.vertices.push_back(transformed(poses[i], actors[i].rest.vertices));
  scene.actors = std::move(actors);
  scene.state = [state](double) { return state; };
  return scene;
}

}  // namespace softbody::virtual_camera
