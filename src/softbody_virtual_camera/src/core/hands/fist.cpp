#include "hands/fist.h"

#include <Eigen/Dense>
#include <vector>

#include "softbody_virtual_camera/bodies/shapes.h"

namespace softbody::virtual_camera {
namespace {

constexpr double kThick = 0.011, kWrist = 0.025, kArm = 0.036, kArmLength = 0.28;  // radii, length [m]

struct Box {
  Eigen::Vector3d low, high;
};

/// The bounding box of the end that the fist encloses.
Box heldBox(const Points& body, double outward, double end) {
  Box box{Eigen::Vector3d::Constant(1e9), Eigen::Vector3d::Constant(-1e9)};
  for (Eigen::Index i = 0; i < body.rows(); ++i) {
    if (outward * body(i, 0) < end - kFistLength) continue;
    box.low = box.low.cwiseMin(body.row(i).transpose());
    box.high = box.high.cwiseMax(body.row(i).transpose());
  }
  return box;
}

/// A finger and the palm opposite it, closed around the end.
void addRing(const Box& held, double x, std::vector<TriangleMesh>* parts) {
  const Eigen::Vector3d low = held.low.array() - kThick, high = held.high.array() + kThick;
  const Eigen::Vector3d corners[] = {
      {x, low.y(), low.z()}, {x, low.y(), high.z()}, {x, high.y(), high.z()}, {x, high.y(), low.z()}};
  for (int k = 0; k < 4; ++k) parts->push_back(capsule(corners[k], corners[(k + 1) % 4], kThick));
}

/// What closes the fist beyond the end.
void addHeel(const Box& held, double x, std::vector<TriangleMesh>* parts) {
  for (double z = held.low.z(); z <= held.high.z() + kThick; z += 1.2 * kThick)
    parts->push_back(capsule({x, held.low.y(), z}, {x, held.high.y(), z}, kThick));
}

}  // namespace

TriangleMesh makeFist(const Points& body, double outward) {
  constexpr int kFingers = 4;
  const double end = (outward * body.col(0)).maxCoeff(), spacing = (kFistLength - kThick) / (kFingers - 1);
  const Box held = heldBox(body, outward, end);
  std::vector<TriangleMesh> parts;
  for (int finger = 0; finger < kFingers; ++finger) addRing(held, outward * (end - finger * spacing), &parts);
  const double heel = end + kThick;
  addHeel(held, outward * heel, &parts);
  const Eigen::Vector3d middle = 0.5 * (held.low + held.high), along = outward * Eigen::Vector3d::UnitX();
  const Eigen::Vector3d wrist = (heel - outward * middle.x()) * along + middle;
  parts.push_back(capsule(wrist, wrist + kArmLength * along, kWrist, kArm));
  return merge(parts);
}

}  // namespace softbody::virtual_camera
