#include "softbody_virtual_camera/scenes/robot.h"

#include <fmt/format.h>

#include <Eigen/Dense>

#include "softbody_virtual_camera/bodies/shapes.h"

namespace softbody::virtual_camera {
namespace {

/// Roll, pitch and yaw, as URDF has them.
std::string originText(const Eigen::Isometry3d& T) {
  const Eigen::Vector3d p = T.translation(), turns = T.linear().eulerAngles(2, 1, 0);
  return fmt::format(R"(<origin xyz="{:.9g} {:.9g} {:.9g}" rpy="{:.9g} {:.9g} {:.9g}"/>)", p.x(), p.y(),
                     p.z(), turns[2], turns[1], turns[0]);
}

std::string shapeText(const RobotLink& link) {
  if (link.radius_m > 0.0)
    return fmt::format(R"(<cylinder radius="{:.9g}" length="{:.9g}"/>)", link.radius_m, link.length_m);
  return fmt::format(R"(<box size="{:.9g} {:.9g} {:.9g}"/>)", link.box.x(), link.box.y(), link.box.z());
}

}  // namespace

TriangleMesh linkMesh(const RobotLink& link) {
  TriangleMesh mesh = link.radius_m > 0.0 ? cylinder(link.radius_m, link.length_m) : box(link.box);
  mesh.vertices = transformed(link.T_link_shape, mesh.vertices);
  return mesh;
}

Robot scaled(Robot robot, double factor) {
  for (RobotLink& link : robot) {
    link.T_parent_joint.translation() *= factor;
    link.T_link_shape.translation() *= factor;
    link.box *= factor;
    link.radius_m *= factor;
    link.length_m *= factor;
  }
  return robot;
}

std::string urdfText(const Robot& robot) {
  std::string text = "<?xml version=\"1.0\"?>\n<robot name=\"arm\">\n";
  for (std::size_t i = 0; i < robot.size(); ++i) {
    const std::string shape = fmt::format("      {}\n      <geometry>{}</geometry>\n",
                                          originText(robot[i].T_link_shape), shapeText(robot[i]));
    text += fmt::format(
        "  <link name=\"{}\">\n    <visual>\n{}    </visual>\n    <collision>\n{}    </collision>\n  "
        "</link>\n",
        robot[i].name, shape, shape);
    if (i == 0) continue;
    text += fmt::format(
        "  <joint name=\"{}_joint\" type=\"continuous\">\n    <parent link=\"{}\"/>\n    <child "
        "link=\"{}\"/>\n"
        "    {}\n    <axis xyz=\"0 0 1\"/>\n  </joint>\n",
        robot[i].name, robot[i - 1].name, robot[i].name, originText(robot[i].T_parent_joint));
  }
  return text + "</robot>\n";
}

}  // namespace softbody::virtual_camera
