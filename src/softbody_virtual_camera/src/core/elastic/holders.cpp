#include "elastic/holders.h"

#include <Eigen/Dense>

#include "softbody_virtual_camera/bodies/shapes.h"

namespace softbody::virtual_camera {

Clamp makeClamp(const Points& rest, double table_m) {
  constexpr double kWall = 0.006, kPost = 0.014;  // [m]
  const double face = rest.col(0).minCoeff() + kClampLength_m;
  Eigen::Vector3d low = Eigen::Vector3d::Constant(1e9), high = -low;
  for (Eigen::Index i = 0; i < rest.rows(); ++i) {
    if (rest(i, 0) > face) continue;
    low = low.cwiseMin(rest.row(i).transpose());
    high = high.cwiseMax(rest.row(i).transpose());
  }
  low.array() -= kWall;
  high.array() += kWall;
  high.x() = face;
  Clamp clamp;
  clamp.T_body_clamp.translation() << face, 0.5 * (low + high).tail<2>();
  TriangleMesh block = box(high - low);
  block.vertices.rowwise() += 0.5 * (low + high).transpose() - clamp.T_body_clamp.translation().transpose();
  const double middle = -0.5 * (high.x() - low.x());
  const double foot = table_m - clamp.T_body_clamp.translation().z();
  clamp.mesh = merge({block, capsule({middle, 0.0, 0.0}, {middle, 0.0, foot}, kPost)});
  return clamp;
}

void addFrame(const std::string& name, const std::function<Eigen::Isometry3d(double t)>& T_camera_frame,
              Play* play) {
  play->frames = [=, others = play->frames](double t) {
    std::vector<FramePose> all = others ? others(t) : std::vector<FramePose>();
    all.push_back({name, T_camera_frame(t)});
    return all;
  };
}

void addClamp(const Stage& stage, const Clamp& clamp, Play* play) {
  const Eigen::Isometry3d pose = stage.T_camera_body * clamp.T_body_clamp;
  addFrame(
      "clamp", [pose](double) { return pose; }, play);
  play->props.push_back(rigidProp({clamp.mesh, darkPaint(), 2.0e-3}, [pose](double) { return pose; }));
}

void addGripper(const Stage& stage, const Gripper& gripper,
                const std::function<Eigen::Isometry3d(double t)>& T_body_moved, Play* play) {
  const auto state = [=](double t) {
    GripperState now = transformed(stage.T_camera_body * T_body_moved(t), posed(gripper, 0.0));
    now.closed = true;
    return now;
  };
  play->gripper = state;
  play->props.push_back(
      rigidProp({gripper.hand, darkPaint(), 4e-3}, [=](double t) { return state(t).T_camera_gripper; }));
  for (const std::size_t side : {0u, 1u}) {
    play->props.push_back(rigidProp({gripper.finger, darkPaint(), 4e-3},
                                    [=](double t) { return state(t).T_camera_fingers.at(side); }));
  }
}

Holder holderOf(const Clamp& clamp, const Points& rest_nodes) {
  Holder holder{"clamp", {}, clamp.T_body_clamp};
  for (Eigen::Index i = 0; i < rest_nodes.rows(); ++i) holder.held.push_back(clamp.holds(rest_nodes.row(i)));
  return holder;
}

Gripper wideGripper(const TriangleMesh& rest) {
  constexpr double kDepth = 0.01;  // [m]; it then holds four cells of the solver
  const double width = rest.vertices.col(1).maxCoeff() - rest.vertices.col(1).minCoeff();
  return makeGripper(rest, Eigen::Vector3d::UnitX(), {width, kDepth});
}

Holder holderOf(const Gripper& gripper, const Points& rest_nodes) {
  Holder holder{"gripper", {}, gripper.T_body_gripper};
  for (Eigen::Index i = 0; i < rest_nodes.rows(); ++i)
    holder.held.push_back(rest_nodes(i, 0) > gripper.inner_end.x() - 1e-9);
  return holder;
}

double tableHeight(const Stage& stage) {
  return -(stage.T_camera_world.inverse() * stage.T_camera_body).translation().z();
}

Texture darkPaint() {
  return [](const Eigen::Vector3d&) { return Eigen::Vector3f(0.24f, 0.25f, 0.28f); };
}

std::vector<bool> heldByAny(const std::vector<Holder>& holders) {
  std::vector<bool> held;
  for (const Holder& holder : holders) {
    held.resize(holder.held.size());
    for (std::size_t i = 0; i < held.size(); ++i) held[i] = held[i] || holder.held[i];
  }
  return held;
}

ContactWrench wrenchOn(const Holder& holder, const Points& nodes, const Points& forces) {
  const Eigen::Isometry3d T_frame_body = holder.T_body_frame.inverse();
  ContactWrench wrench{holder.name};
  for (Eigen::Index i = 0; i < nodes.rows(); ++i) {
    if (!holder.held[static_cast<std::size_t>(i)]) continue;
    const Eigen::Vector3d place = T_frame_body * nodes.row(i).transpose();
    const Eigen::Vector3d force = -(T_frame_body.linear() * forces.row(i).transpose());
    wrench.force += force;
    wrench.torque += place.cross(force);
  }
  return wrench;
}

}  // namespace softbody::virtual_camera
