#include "hands/hand.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "softbody_virtual_camera/bodies/shapes.h"

namespace softbody::virtual_camera {
namespace {

constexpr double kPadRadius = 0.0085, kKnuckleRadius = 0.0105, kPalmRadius = 0.013, kWristRadius = 0.025,
                 kArmRadius = 0.036;           // [m]
constexpr double kSpread = 0.6;                // how far the open fingers are turned away [rad]
constexpr double kHeld = 0.05, kNudge = 1e-4;  // length of the held end; step of differences [m]

struct Bone {
  Eigen::Vector3d from, to;
  double from_radius, to_radius;
};

/// The axes of the hand: outwards, to the finger pads, and across the fingers towards the thumb.
Eigen::Matrix3d axesOf(const Grip& grip) {
  Eigen::Vector3d across = grip.outward.cross(grip.fingers);
  if (across.dot(grip.thumb) < 0.0) across = -across;
  Eigen::Matrix3d axes;
  axes << grip.outward, grip.fingers, across;
  return axes;
}

/// The side of the body across this axis that the camera sees: the top or the front.
Eigen::Vector3d seenSide(const Eigen::Vector3d& axis) {
  const Eigen::Vector3d up = Eigen::Vector3d::UnitZ(), front = -Eigen::Vector3d::UnitY();
  return std::abs(axis.z()) > 0.5 ? up : front;
}

Digit finger(const TriangleMesh& body, const Grip& grip, int number) {
  constexpr double kTips[] = {0.046, 0.052, 0.048, 0.038};  // of the index finger and so on [m]
  const Eigen::Matrix3d axes = axesOf(grip);
  const double across = (grip.flat_palm ? 0.024 : 0.020) * (1.5 - number), tip = kTips[number];
  Digit digit;
  digit.side = grip.fingers;
  digit.start = grip.center + across * axes.col(2);
  digit.profile = profileOf(body, digit.start, -grip.outward, digit.side);
  const double height = digit.profile.at(0.01);
  if (grip.flat_palm) {
    digit.joints = {0.64 * tip + 0.012, 0.32 * tip + 0.012, 0.010};
    digit.knuckle = axes * Eigen::Vector3d(kKnuckleRadius, height + 0.010, across);
    digit.root = axes * Eigen::Vector3d(kPalmRadius, height - 0.062, 0.7 * across);
  } else {
    digit.joints = {tip, 0.5 * tip, 0.002};
    digit.knuckle = axes * Eigen::Vector3d(0.031, height + 0.002, 0.97 * across);
    digit.root = axes * Eigen::Vector3d(0.105, 0.4 * height, 0.6 * across);
  }
  return digit;
}

Digit thumb(const TriangleMesh& body, const Grip& grip) {
  const Eigen::Matrix3d axes = axesOf(grip);
  Digit digit;
  digit.side = grip.thumb;
  digit.start = grip.center + (grip.flat_palm ? 0.0 : 0.014) * axes.col(2);
  digit.profile = profileOf(body, digit.start, -grip.outward, digit.side);
  const double height = digit.profile.at(0.01);
  if (grip.flat_palm) {
    digit.joints = {0.040, 0.024, 0.010};
    digit.knuckle = axes * Eigen::Vector3d(kPalmRadius, -0.012, height);
    digit.root = axes * Eigen::Vector3d(kPalmRadius, -0.035, height - 0.035);
  } else {
    digit.joints = {0.036, 0.020, 0.003};
    digit.knuckle = height * grip.thumb + axes * Eigen::Vector3d(0.035, 0.0, 0.022);
    digit.root = axes * Eigen::Vector3d(0.085, 0.0, 0.026);
  }
  return digit;
}

/// The frame of the body's end, which carries the palm.
Eigen::Isometry3d endFrame(const Grip& grip, const Deformation& body) {
  const Eigen::Matrix3d rest = axesOf(grip);
  const auto moved = [&](int axis) -> Eigen::Vector3d {
    return (body(grip.center + kNudge * rest.col(axis)) - body(grip.center - kNudge * rest.col(axis)))
        .normalized();
  };
  const Eigen::Vector3d outward = moved(0);
  const Eigen::Vector3d fingers = (moved(1) - moved(1).dot(outward) * outward).normalized();
  Eigen::Matrix3d axes;
  axes << outward, fingers, outward.cross(fingers) * rest.determinant();
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.linear() = axes * rest.transpose();
  T.translation() = body(grip.center);
  return T;
}

/// The centre of a joint whose pad touches the deformed body.
Eigen::Vector3d touching(const Digit& digit, const Grip& grip, const HandPose& pose, double distance) {
  const double place = distance / (1.0 + pose.strain);
  const Eigen::Vector3d contact = digit.start - place * grip.outward + digit.profile.at(place) * digit.side;
  const Eigen::Vector3d out = pose.body(contact + kNudge * digit.side) - pose.body(contact);
  return pose.body(contact) + kPadRadius * out.normalized();
}

std::vector<Bone> bonesOf(const Digit& digit, const Grip& grip, const HandPose& pose,
                          const Eigen::Isometry3d& T_body_end) {
  const Eigen::Vector3d knuckle = T_body_end * digit.knuckle;
  const Eigen::Vector3d hinge = T_body_end.linear() * digit.side.cross(grip.outward);
  const Eigen::AngleAxisd opened(pose.open * kSpread, hinge);
  std::vector<Eigen::Vector3d> joints;
  for (const double distance : digit.joints)
    joints.push_back(knuckle + opened * (touching(digit, grip, pose, distance) - knuckle));
  return {{joints[1], joints[0], kPadRadius, 0.9 * kPadRadius},
          {joints[2], joints[1], kPadRadius, kPadRadius},
          {knuckle, joints[2], kKnuckleRadius, kPadRadius},
          {T_body_end * digit.root, knuckle, kPalmRadius, kKnuckleRadius}};
}

/// The broad palm, the wrist and the arm.
std::vector<Bone> armOf(const Hand& hand, const Eigen::Isometry3d& T_body_end) {
  constexpr double kLength = 0.26;  // [m]
  const Eigen::Vector3d& out = hand.grip.outward;
  const Eigen::Vector3d heel = 0.5 * (hand.digits[1].root + hand.digits[2].root);
  const Eigen::Vector3d wrist = heel + (hand.grip.flat_palm ? 0.030 : 0.015) * out;
  const Eigen::Vector3d elbow = wrist + kLength * out;
  const Digit &index = hand.digits[0], &little = hand.digits[3];
  const auto across = [&](double share) -> Bone {
    return {T_body_end * ((1.0 - share) * index.knuckle + share * index.root),
            T_body_end * ((1.0 - share) * little.knuckle + share * little.root), kKnuckleRadius,
            kKnuckleRadius};
  };
  return {across(0.0),
          across(0.3),
          across(0.6),
          {T_body_end * heel, T_body_end * wrist, kPalmRadius, kWristRadius},
          {T_body_end * wrist, T_body_end * elbow, kWristRadius, kArmRadius}};
}

std::vector<Bone> bonesOf(const Hand& hand, const HandPose& pose) {
  const Eigen::Isometry3d T_body_end = endFrame(hand.grip, pose.body);
  std::vector<Bone> bones = armOf(hand, T_body_end);
  for (const Digit& digit : hand.digits) {
    for (const Bone& bone : bonesOf(digit, hand.grip, pose, T_body_end)) bones.push_back(bone);
  }
  for (Bone& bone : bones) {
    bone.from += pose.away_m * hand.grip.outward;
    bone.to += pose.away_m * hand.grip.outward;
  }
  return bones;
}

HandPose touchingAtRest() {
  HandPose pose;
  pose.body = [](const Eigen::Vector3d& rest) { return rest; };
  return pose;
}

/// The middle of the held end's bounding box, at its outermost point; and the box's size.
std::pair<Eigen::Vector3d, Eigen::Vector3d> heldEnd(const Points& body, const Eigen::Vector3d& outward) {
  const double end = (body * outward).maxCoeff();
  Eigen::Vector3d low = Eigen::Vector3d::Constant(1e9), high = -low;
  for (Eigen::Index i = 0; i < body.rows(); ++i) {
    if (body.row(i).dot(outward) < end - kHeld) continue;
    low = low.cwiseMin(body.row(i).transpose());
    high = high.cwiseMax(body.row(i).transpose());
  }
  const Eigen::Vector3d middle = 0.5 * (low + high);
  return {middle + (end - middle.dot(outward)) * outward, high - low};
}

}  // namespace

Grip holdingGrip(const Points& body, const Eigen::Vector3d& outward) {
  const auto [center, size] = heldEnd(body, outward);
  const Eigen::Vector3d side =
      seenSide(size.z() <= size.y() ? Eigen::Vector3d::UnitZ() : Eigen::Vector3d::UnitY());
  return {center, outward, side, -side};
}

Grip pushingGrip(const Points& body, const Eigen::Vector3d& outward) {
  Grip grip = holdingGrip(body, outward);
  grip.thumb = seenSide(grip.outward.cross(grip.fingers));
  grip.flat_palm = true;
  return grip;
}

Hand makeHand(const TriangleMesh& body, const Grip& grip) {
  Hand hand{grip, {}, {}};
  for (int number = 0; number < 4; ++number) hand.digits.push_back(finger(body, grip, number));
  hand.digits.push_back(thumb(body, grip));
  std::vector<TriangleMesh> parts;
  for (const Bone& bone : bonesOf(hand, touchingAtRest()))
    parts.push_back(capsule(bone.from, bone.to, bone.from_radius, bone.to_radius));
  hand.mesh = merge(parts);
  return hand;
}

Points posed(const Hand& hand, const HandPose& pose) {
  const std::vector<Bone> rest = bonesOf(hand, touchingAtRest()), now = bonesOf(hand, pose);
  const Eigen::Index a_bone = hand.mesh.vertices.rows() / static_cast<Eigen::Index>(now.size());
  Points vertices = hand.mesh.vertices;
  for (std::size_t i = 0; i < now.size(); ++i) {
    const Eigen::Matrix3d turn =
        Eigen::Quaterniond::FromTwoVectors(rest[i].to - rest[i].from, now[i].to - now[i].from)
            .toRotationMatrix();
    const Eigen::Index first = static_cast<Eigen::Index>(i) * a_bone;
    for (Eigen::Index k = first; k < first + a_bone; ++k) {
      const bool beginning = k < first + a_bone / 2;  // the capsule's vertices begin at its first end
      const Eigen::Vector3d &from = beginning ? rest[i].from : rest[i].to,
                            &to = beginning ? now[i].from : now[i].to;
      vertices.row(k) = (to + turn * (vertices.row(k).transpose() - from)).transpose();
    }
  }
  return vertices;
}

}  // namespace softbody::virtual_camera
