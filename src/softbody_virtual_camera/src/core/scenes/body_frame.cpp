#include "scenes/body_frame.h"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <stdexcept>

namespace softbody::virtual_camera {
namespace {

constexpr double kLength = 0.2, kShortest = 0.05, kLongest = 2.0;  // [m]

Points ownRows(const BodyFrame& frame, const Points& played) {
  return (frame.scale * played * frame.turn).rowwise() + frame.center.transpose();
}

Eigen::Isometry3d ownPose(const BodyFrame& frame, const Eigen::Isometry3d& T_camera_played) {
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.linear() = T_camera_played.linear() * frame.turn;
  T.translation() = frame.scale * T_camera_played.translation() - T.linear() * frame.center;
  return T;
}

/// The same mass per length, time and elasticity, in the body's own lengths.
TrueMaterial scaled(TrueMaterial material, double factor) {
  *material.elasticity.density_kg_m3 /= factor * factor;
  material.volume_m3 *= factor * factor * factor;
  return material;
}

std::vector<ContactWrench> scaled(std::vector<ContactWrench> wrenches, double factor) {
  for (ContactWrench& wrench : wrenches) {
    wrench.force *= factor * factor;
    wrench.torque *= factor * factor * factor;
  }
  return wrenches;
}

/// Of a body with the same elasticity.
std::vector<SurfaceForce> scaled(std::vector<SurfaceForce> forces, double factor) {
  for (SurfaceForce& force : forces) {
    force.place *= factor;
    force.force *= factor * factor;
  }
  return forces;
}

}  // namespace

BodyFrame frameOf(const Points& rest) {
  const Eigen::Vector3d low = rest.colwise().minCoeff(), high = rest.colwise().maxCoeff();
  Eigen::Index axis = 0;
  const double length = (high - low).maxCoeff(&axis);
  if (!(length >= kShortest && length <= kLongest)) {
    throw std::invalid_argument(fmt::format("the body is {:.4g} m long; allowed: {} to {} m; check its unit",
                                            length, kShortest, kLongest));
  }
  BodyFrame frame;
  if (axis == 1) frame.turn << 0, 1, 0, -1, 0, 0, 0, 0, 1;
  if (axis == 2) frame.turn << 0, 0, 1, 0, 1, 0, -1, 0, 0;
  frame.center = 0.5 * (low + high);
  frame.scale = length / kLength;
  return frame;
}

Points toSceneFrame(const BodyFrame& frame, const Points& own) {
  return (own.rowwise() - frame.center.transpose()) * frame.turn.transpose() / frame.scale;
}

Scene toBodyFrame(const BodyFrame& frame, const Scene& played, const TriangleMesh& body) {
  Scene scene = played;
  for (Actor& actor : scene.actors) {
    actor.rest.vertices *= frame.scale;
    actor.texel_m *= frame.scale;
    actor.texture = [=, texture = actor.texture](const Eigen::Vector3d& p) {
      return texture(p / frame.scale);
    };
  }
  scene.actors.at(0).rest = body;
  scene.actors.at(0).texture = [=, texture = played.actors.at(0).texture](const Eigen::Vector3d& p) {
    return texture(frame.turn * (p - frame.center) / frame.scale);
  };
  scene.T_camera_world.translation() *= frame.scale;
  if (scene.material) scene.material = scaled(*scene.material, frame.scale);
  scene.robot = scaled(played.robot, frame.scale);
  for (Edit& edit : scene.edits) {
    edit.topology.rest_vertices = ownRows(frame, edit.topology.rest_vertices);
    edit.patch.vertices = ownRows(frame, edit.patch.vertices);
  }
  scene.state = [=, state = played.state](double t) {
    SceneState now = state(t);
    now.T_camera_body = ownPose(frame, now.T_camera_body);
    for (Points& vertices : now.vertices) vertices *= frame.scale;
    if (now.T_camera_tool) now.T_camera_tool->translation() *= frame.scale;
    if (now.forces) now.forces = scaled(*now.forces, frame.scale);
    for (FramePose& thing : now.frames) thing.T_camera_frame.translation() *= frame.scale;
    now.wrenches = scaled(std::move(now.wrenches), frame.scale);
    if (now.T_camera_second) now.T_camera_second->translation() *= frame.scale;
    for (LinkPose& link : now.links) link.T_camera_link.translation() *= frame.scale;
    if (now.gripper) now.gripper = scaled(*now.gripper, frame.scale);
    return now;
  };
  return scene;
}

}  // namespace softbody::virtual_camera
