#include <fmt/format.h>
#include <Eigen/Dense>

#include <cmath>
#include <map>
#include <stdexcept>

#include "softbody_bringup/virtual_camera/bend.h"
#include "softbody_bringup/virtual_camera/random.h"
#include "softbody_bringup/virtual_camera/scene.h"

/// World frame of the scenes: origin on the table below the body, z up, the camera looks along +y and down.
namespace softbody::virtual_camera {
namespace {

constexpr double kDegree = 3.14159265358979323846 / 180.0;

/// Optical frame of a camera at `eye` that looks at `target`, its x axis level.
Eigen::Isometry3d lookAt(const Eigen::Vector3d& eye, const Eigen::Vector3d& target) {
  const Eigen::Vector3d forward = (target - eye).normalized();
  const Eigen::Vector3d right = forward.cross(Eigen::Vector3d::UnitZ()).normalized();
  Eigen::Isometry3d T_world_camera = Eigen::Isometry3d::Identity();
  T_world_camera.linear() << right, forward.cross(right), forward;
  T_world_camera.translation() = eye;
  return T_world_camera.inverse();
}

Points transformed(const Eigen::Isometry3d& T, const Points& points) {
  return (points * T.linear().transpose()).rowwise() + T.translation().transpose();
}

/// A rectangle from a corner and two edges; its front is edge_u x edge_v.
TriangleMesh rectangle(const Eigen::Vector3d& corner, const Eigen::Vector3d& edge_u,
                       const Eigen::Vector3d& edge_v) {
  TriangleMesh mesh{Points(4, 3), Triangles(2, 3)};
  mesh.vertices << corner.transpose(), (corner + edge_u).transpose(), (corner + edge_u + edge_v).transpose(),
      (corner + edge_v).transpose();
  mesh.triangles << 0, 1, 2, 0, 2, 3;
  return mesh;
}

/// The set that all scenes share: camera, light, table and wall, and the body where it rests.
struct Stage {
  Eigen::Isometry3d T_camera_world, T_camera_body;
  Scene scene;
};

Stage makeStage(const std::string& name, const TriangleMesh& body, std::uint64_t seed) {
  constexpr double kHeight = 0.08, kDistance = 0.5, kElevation = 42.0 * kDegree, kYaw = 25.0 * kDegree;
  const Eigen::Vector3d center(0.0, 0.0, kHeight);
  const Eigen::Vector3d eye =
      center + kDistance * Eigen::Vector3d(0.0, -std::cos(kElevation), std::sin(kElevation));
  Stage stage;
  stage.T_camera_world = lookAt(eye, center);
  stage.T_camera_body =
      stage.T_camera_world * Eigen::Translation3d(center) * Eigen::AngleAxisd(kYaw, Eigen::Vector3d::UnitZ());
  stage.scene.name = name;
  stage.scene.to_light = stage.T_camera_world.linear() * Eigen::Vector3d(-0.45, -0.35, 0.82).normalized();
  const TriangleMesh table = rectangle({-0.8, -0.3, 0.0}, {1.6, 0.0, 0.0}, {0.0, 0.8, 0.0});
  const TriangleMesh wall = rectangle({-0.8, 0.5, 0.0}, {1.6, 0.0, 0.0}, {0.0, 0.0, 0.8});
  stage.scene.actors = {{body, cellTexture(hash(seed, 1))},
                        {table, woodTexture(hash(seed, 2)), 1.6e-3},
                        {wall, plasterTexture(hash(seed, 3)), 4.0e-3}};
  return stage;
}

/// A scene whose body deforms in its own frame, held in the air before the table.
Scene deformingScene(const std::string& name, const TriangleMesh& body, std::uint64_t seed, double duration_s,
                     std::function<Eigen::Vector3d(const Eigen::Vector3d& rest, double t)> deformation) {
  Stage stage = makeStage(name, body, seed);
  stage.scene.duration_s = duration_s;
  const Points table = transformed(stage.T_camera_world, stage.scene.actors[1].rest.vertices);
  const Points wall = transformed(stage.T_camera_world, stage.scene.actors[2].rest.vertices);
  stage.scene.state = [=, rest = body.vertices, T_camera_body = stage.T_camera_body](double t) {
    Points deformed(rest.rows(), 3);
    for (Eigen::Index i = 0; i < rest.rows(); ++i) deformed.row(i) = deformation(rest.row(i).transpose(), t);
    return SceneState{T_camera_body, {transformed(T_camera_body, deformed), table, wall}};
  };
  return stage.scene;
}

Scene bendScene(const TriangleMesh& body, std::uint64_t seed) {
  return deformingScene("bend", body, seed, 5.0,
                        [](const Eigen::Vector3d& rest, double t) { return bend(rest, bendCurvature(t)); });
}

using SceneMaker = Scene (*)(const TriangleMesh& body, std::uint64_t seed);

const std::map<std::string, SceneMaker>& makers() {
  static const std::map<std::string, SceneMaker> makers = {{"bend", bendScene}};
  return makers;
}

}  // namespace

std::vector<std::string> sceneNames() {
  std::vector<std::string> names;
  for (const auto& [name, maker] : makers()) names.push_back(name);
  return names;
}

Scene makeScene(const std::string& name, const TriangleMesh& body, std::uint64_t seed) {
  const auto found = makers().find(name);
  if (found == makers().end()) {
    throw std::invalid_argument(
        fmt::format("there is no scene '{}'; known: {}", name, fmt::join(sceneNames(), ", ")));
  }
  return found->second(body, seed);
}

}  // namespace softbody::virtual_camera
