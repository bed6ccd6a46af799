#include "softbody_virtual_camera/scenes/scene.h"

#include <fmt/format.h>

#include <utility>

namespace softbody::virtual_camera {

std::string materialText(const TrueMaterial& material) {
  const Elasticity& e = material.elasticity;
  return fmt::format(
      "youngs_modulus_pa: {:.9g}\npoisson_ratio: {:.9g}\ndensity_kg_m3: {:.9g}\ndamping: {:.9g}\n"
      "mass_kg: {:.9g}\n",
      e.youngs_modulus_pa, e.poisson_ratio, *e.density_kg_m3, e.damping, material.mass());
}

GripperState transformed(const Eigen::Isometry3d& T, GripperState gripper) {
  gripper.T_camera_gripper = T * gripper.T_camera_gripper;
  for (Eigen::Isometry3d& finger : gripper.T_camera_fingers) finger = T * finger;
  return gripper;
}

GripperState scaled(GripperState gripper, double factor) {
  gripper.T_camera_gripper.translation() *= factor;
  for (Eigen::Isometry3d& finger : gripper.T_camera_fingers) finger.translation() *= factor;
  return gripper;
}

std::vector<SurfaceForce> transformed(const Eigen::Isometry3d& T, std::vector<SurfaceForce> forces) {
  for (SurfaceForce& force : forces) {
    force.place = T * force.place;
    force.normal = T.linear() * force.normal;
    force.force = T.linear() * force.force;
  }
  return forces;
}

Scene withoutHands(Scene scene) {
  const std::size_t kept = scene.actors.size() - std::exchange(scene.hands, 0);
  scene.actors.resize(kept);
  scene.second.reset();
  scene.robot.clear();
  scene.state = [kept, with_hands = std::move(scene.state)](double t) {
    SceneState state = with_hands(t);
    state.vertices.resize(kept);
    state.T_camera_second.reset();
    state.links.clear();
    return state;
  };
  return scene;
}

}  // namespace softbody::virtual_camera
