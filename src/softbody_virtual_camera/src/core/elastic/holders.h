#pragma once

#include <functional>
#include <string>
#include <vector>

#include "scenes/gripper.h"
#include "scenes/stage.h"

namespace softbody::virtual_camera {

/// A block on a post that holds the end of a body at negative x. Its frame has the axes of the body's frame,
/// and its origin is the middle of the face towards the body.
struct Clamp {
  Eigen::Isometry3d T_body_clamp = Eigen::Isometry3d::Identity();
  TriangleMesh mesh;  ///< in the clamp's frame

  bool holds(const Eigen::Vector3d& rest) const { return rest.x() < T_body_clamp.translation().x() + 1e-9; }
};

constexpr double kClampLength_m = 0.04;  ///< of the end that it holds: four cells of the solver

/// @param table_m height of the table in the body's frame.
Clamp makeClamp(const Points& rest, double table_m);

/// Adds the clamp, which does not move, and its frame.
void addClamp(const Stage& stage, const Clamp& clamp, Play* play);

/// Adds a closed gripper and its frames. @param T_body_moved from its pose at rest, in the body's frame at
/// the start.
void addGripper(const Stage& stage, const Gripper& gripper,
                const std::function<Eigen::Isometry3d(double t)>& T_body_moved, Play* play);

/// Adds a thing's frame to those of a play.
void addFrame(const std::string& name, const std::function<Eigen::Isometry3d(double t)>& T_camera_frame,
              Play* play);

/// What holds a part of a body.
struct Holder {
  std::string name;                ///< of its frame
  std::vector<bool> held;          ///< for each node
  Eigen::Isometry3d T_body_frame;  ///< its frame
};

Holder holderOf(const Clamp& clamp, const Points& rest_nodes);
/// A closed gripper at positive x, whose fingers are as wide as the body.
Gripper wideGripper(const TriangleMesh& rest);
/// All that is beyond the inner end of the fingers.
Holder holderOf(const Gripper& gripper, const Points& rest_nodes);

/// For each node, whether one of them holds it; empty without any.
std::vector<bool> heldByAny(const std::vector<Holder>& holders);

/// What the body does to a holder. @param nodes #N by 3 [m]. @param forces of the holder on them [N].
ContactWrench wrenchOn(const Holder& holder, const Points& nodes, const Points& forces);

/// Height of the table in the body's frame, at the start [m].
double tableHeight(const Stage& stage);

/// The paint of clamps, supports and plates.
Texture darkPaint();

}  // namespace softbody::virtual_camera
