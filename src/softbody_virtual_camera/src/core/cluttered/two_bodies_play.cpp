#include "cluttered/two_bodies_play.h"

#include <Eigen/Dense>
#include <algorithm>
#include <stdexcept>

#include "cluttered/draws.h"
#include "motion/deformations.h"
#include "motion/motion_profiles.h"
#include "softbody_virtual_camera/bodies/shapes.h"
#include "textures/body_paint.h"

namespace softbody::virtual_camera {
namespace {

constexpr double kBegin_s = 0.5, kCrossing_s = 2.5;

/// The way of the second body: from one side of the first one, before it, to its other side.
std::function<Eigen::Isometry3d(double t)> wayOf(const Stage& stage, const Points& second) {
  constexpr double kAside = 0.23, kNearer = 0.20, kLeastHeight = 0.02, kMostTurn = 0.3;  // [m], [rad]
  constexpr double kPi = 3.14159265358979323846;
  Draws draws(hash(stage.seed, 47));
  const double side = draws.sign(), lift = draws.sign() * draws.between(0.03, 0.045);
  const Eigen::Isometry3d T_world_body = stage.T_camera_world.inverse() * stage.T_camera_body;
  const double up = std::max(0.0, kLeastHeight - second.col(2).minCoeff() - T_world_body.translation().z());
  const Eigen::Vector3d start = stage.T_camera_body.translation() + stage.T_camera_world.linear().col(2) * up;
  const Eigen::Matrix3d turn =
      stage.T_camera_body.linear() *
      Eigen::AngleAxisd(draws.between(-kMostTurn, kMostTurn), Eigen::Vector3d::UnitZ());
  return [=](double t) {
    const double phase = kPi * smoothStep((t - kBegin_s) / kCrossing_s);
    Eigen::Isometry3d T_camera_second = Eigen::Isometry3d::Identity();
    T_camera_second.linear() = turn;
    T_camera_second.translation() =
        start +
        Eigen::Vector3d(side * kAside * std::cos(phase), lift * std::sin(phase), -kNearer * std::sin(phase));
    return T_camera_second;
  };
}

Eigen::Vector3d bent(const Eigen::Vector3d& place, double curvature, double t) {
  return bend(place, curvature * plateau(t, {kBegin_s, 0.5 * kCrossing_s, 0.0}));
}

}  // namespace

Play twoBodiesPlay(const Stage& stage) {
  constexpr double kCurvature = 4.0, kSecondCurvature = 3.0;  // [1/m]
  if (!stage.second) throw std::invalid_argument("this scene needs a second body");
  const TriangleMesh& rest = stage.second->rest;
  const auto pose = wayOf(stage, rest.vertices);
  Play play;
  play.name = "two_bodies";
  play.duration_s = 3.5;
  play.repeats = false;
  play.deformation = [](const Eigen::Vector3d& place, double t) { return bent(place, kCurvature, t); };
  play.T_camera_second = pose;
  Prop second{{rest, textureOf(stage.paint, hash(stage.seed, 4))}, [=, vertices = rest.vertices](double t) {
                Points now = vertices;
                for (Eigen::Index i = 0; i < now.rows(); ++i)
                  now.row(i) = bent(vertices.row(i), kSecondCurvature, t);
                return transformed(pose(t), now);
              }};
  second.actor.skin = withContrast(stage.second->skin, stage.paint.contrast);
  play.props = {second};
  return play;
}

}  // namespace softbody::virtual_camera
