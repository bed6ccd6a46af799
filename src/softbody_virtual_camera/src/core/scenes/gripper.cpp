#include "scenes/gripper.h"

#include <Eigen/Dense>
#include <algorithm>

#include "hands/body_profile.h"
#include "hands/hand.h"
#include "softbody_virtual_camera/bodies/shapes.h"

namespace softbody::virtual_camera {
namespace {

constexpr double kFingerThick = 0.01, kFingerLong = 0.06;  // [m]
const Eigen::Vector3d kPalm(0.05, 0.14, 0.03);             // [m]
constexpr double kStroke = 0.03;                           // of a finger [m]
constexpr double kArmThickness = 0.03, kArmReach = 0.3;    // [m]

/// The outermost place of the body under a finger.
double heightUnder(const TriangleMesh& body, const Grip& grip, const Eigen::Vector3d& side,
                   const Fingers& fingers) {
  const Eigen::Vector3d across = side.cross(grip.outward);
  double height = 0.0;
  for (const double offset : {-0.5, 0.0, 0.5}) {
    const Eigen::Vector3d start = grip.center + offset * fingers.width_m * across;
    const BodyProfile profile = profileOf(body, start, -grip.outward, side);
    for (double place = 0.0; place <= fingers.depth_m + 0.5 * kFingerLong; place += 0.005)
      height = std::max(height, profile.at(place));
  }
  return height;
}

TriangleMesh handMesh() {
  const double palm_z = -0.5 * (kFingerLong + kPalm.z());
  TriangleMesh palm = box(kPalm);
  palm.vertices.col(2).array() += palm_z;
  const Eigen::Vector3d wrist(0.0, 0.0, palm_z), elbow(0.0, 0.0, palm_z - kArmReach);
  return merge({palm, capsule(wrist, elbow, kArmThickness)});
}

}  // namespace

Gripper makeGripper(const TriangleMesh& body, const Eigen::Vector3d& outward, const Fingers& fingers) {
  const Grip grip = holdingGrip(body.vertices, outward);
  Gripper gripper;
  gripper.T_body_gripper.setIdentity();
  gripper.T_body_gripper.linear() << grip.fingers.cross(-outward), grip.fingers, -outward;
  gripper.T_body_gripper.translation() = grip.center - fingers.depth_m * outward;
  gripper.held_m = {heightUnder(body, grip, grip.thumb, fingers),
                    heightUnder(body, grip, grip.fingers, fingers)};
  gripper.hand = handMesh();
  gripper.finger = box({fingers.width_m, kFingerThick, kFingerLong});
  gripper.inner_end = gripper.T_body_gripper * Eigen::Vector3d(0.0, 0.0, 0.5 * kFingerLong);
  return gripper;
}

GripperState posed(const Gripper& gripper, double open) {
  GripperState state;
  state.T_camera_gripper = gripper.T_body_gripper;
  for (std::size_t side = 0; side < 2; ++side) {
    const double y = gripper.held_m[side] + 0.5 * kFingerThick + open * kStroke;
    state.T_camera_fingers[side] =
        gripper.T_body_gripper * Eigen::Translation3d(0.0, side == 0 ? -y : y, 0.0);
  }
  return state;
}

}  // namespace softbody::virtual_camera
