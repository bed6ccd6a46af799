#include "camera/camera_motion.h"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <cmath>
#include <stdexcept>

#include "softbody_virtual_camera/bodies/shapes.h"

namespace softbody::virtual_camera {
namespace {

constexpr double kDegree = 3.14159265358979323846 / 180.0;
constexpr char kNone[] = "none", kOrbit[] = "orbit";

/// Time that starts slowly, because the arm accelerates from rest.
double easedTime(double t) {
  constexpr double kEase = 0.5;  // [s]
  return t - kEase * std::tanh(t / kEase);
}

/// The camera's pose relative to its first frame.
/// @param center of the orbit, on the optical axis. @param up unit vector; both in the first frame.
Eigen::Isometry3d orbitPose(const Eigen::Vector3d& center, const Eigen::Vector3d& up, double t) {
  // Waves without a common period, so that the phases of body and camera vary.
  constexpr double kTurn = 25.0 * kDegree, kLift = 8.0 * kDegree, kRoll = 5.0 * kDegree;
  constexpr double kFarther = 0.1, kAside = 0.05;  // of the distance
  const double phase = 1.25 * easedTime(t);        // [rad]
  const Eigen::Vector3d offset(kAside * std::sin(1.7 * phase), 0.0, -kFarther * std::sin(0.8 * phase));
  return Eigen::Translation3d(center) * Eigen::AngleAxisd(kTurn * std::sin(phase), up) *
         Eigen::AngleAxisd(kLift * std::sin(1.3 * phase), Eigen::Vector3d::UnitX()) *
         Eigen::AngleAxisd(kRoll * std::sin(0.7 * phase), Eigen::Vector3d::UnitZ()) *
         Eigen::Translation3d(center.norm() * offset - center);
}

Scene orbited(const Scene& scene) {
  const double distance = scene.state(0.0).vertices.at(0).col(2).mean();
  const Eigen::Vector3d center = distance * Eigen::Vector3d::UnitZ();
  const Eigen::Vector3d up = scene.T_camera_world.linear().col(2);
  Scene moved = scene;
  for (Actor& actor : moved.actors) actor.still = false;
  moved.state = [=, state = scene.state, T_world_start = scene.T_camera_world.inverse()](double t) {
    const Eigen::Isometry3d T_start_camera = orbitPose(center, up, t);
    const Eigen::Isometry3d T_camera_start = T_start_camera.inverse();
    SceneState now = state(t);
    for (Points& vertices : now.vertices) vertices = transformed(T_camera_start, vertices);
    now.T_camera_body = T_camera_start * now.T_camera_body;
    if (now.T_camera_tool) now.T_camera_tool = T_camera_start * *now.T_camera_tool;
    if (now.forces) now.forces = transformed(T_camera_start, *now.forces);
    if (now.T_camera_second) now.T_camera_second = T_camera_start * *now.T_camera_second;
    for (LinkPose& link : now.links) link.T_camera_link = T_camera_start * link.T_camera_link;
    for (FramePose& thing : now.frames) thing.T_camera_frame = T_camera_start * thing.T_camera_frame;
    if (now.gripper) now.gripper = transformed(T_camera_start, *now.gripper);
    for (Eigen::Vector3d* to_light : {&now.lights.to_main, &now.lights.to_fill})
      *to_light = T_camera_start.linear() * *to_light;
    now.T_world_camera = T_world_start * T_start_camera;
    return now;
  };
  return moved;
}

}  // namespace

std::vector<std::string> cameraMotionNames() { return {kNone, kOrbit}; }

Scene withCameraMotion(const std::string& motion, const Scene& scene) {
  if (motion == kNone) return scene;
  if (motion == kOrbit) return orbited(scene);
  throw std::invalid_argument(
      fmt::format("there is no camera motion '{}'; known: {}", motion, fmt::join(cameraMotionNames(), ", ")));
}

}  // namespace softbody::virtual_camera
