#include "cluttered/clutter_play.h"

#include <Eigen/Dense>
#include <algorithm>
#include <vector>

#include "cluttered/looks.h"
#include "cluttered/reach.h"
#include "scenes/plays.h"
#include "softbody_virtual_camera/bodies/shapes.h"

namespace softbody::virtual_camera {
namespace {

/// Things on the table are placed in the world's frame.
struct World {
  TriangleMesh body;
  Eigen::Vector3d eye;        ///< of the camera
  Eigen::Vector3d low, high;  ///< bounds of the body
};

World worldOf(const Stage& stage) {
  const Eigen::Isometry3d T_world_camera = stage.T_camera_world.inverse();
  World world;
  world.body = {transformed(T_world_camera * stage.T_camera_body, stage.actors.at(0).rest.vertices),
                stage.actors.at(0).rest.triangles};
  world.eye = T_world_camera.translation();
  world.low = world.body.vertices.colwise().minCoeff();
  world.high = world.body.vertices.colwise().maxCoeff();
  return world;
}

/// A thing in the world's frame that stands on the table, and the circle around it.
struct Standing {
  TriangleMesh mesh;
  Eigen::Isometry3d T_world_thing = Eigen::Isometry3d::Identity();
  double radius = 0.0;
};

Standing drawnShape(Draws* draws) {
  Standing thing;
  double half_height = 0.0;
  if (draws->below(2) == 0) {
    const Eigen::Vector3d size(draws->between(0.03, 0.07), draws->between(0.03, 0.07),
                               draws->between(0.03, 0.08));
    thing.mesh = box(size);
    thing.radius = 0.5 * size.head<2>().norm();
    half_height = 0.5 * size.z();
  } else {
    half_height = thing.radius = draws->between(0.018, 0.035);
    thing.mesh = ball(thing.radius);
  }
  thing.T_world_thing.translation().z() = half_height;
  return thing;
}

/// Turns a thing and moves it along a direction on the table, until a gap is left to the body.
void putBeside(const World& world, double angle, double gap, Standing* thing) {
  const Eigen::Vector3d out(std::cos(angle), std::sin(angle), 0.0), up = Eigen::Vector3d::UnitZ();
  const Eigen::Vector3d half = thing->mesh.vertices.cwiseAbs().colwise().maxCoeff();
  const Eigen::Vector3d middle = 0.5 * (world.low + world.high);
  Eigen::Isometry3d T_world_face = Eigen::Isometry3d::Identity();
  T_world_face.linear() << up.cross(out), up, out;
  T_world_face.translation() << middle.x(), middle.y(), half.z();
  const double reach = reachOf(world.body, T_world_face, {half.y(), half.z()});
  thing->T_world_thing =
      Eigen::Translation3d(T_world_face * Eigen::Vector3d(0.0, 0.0, reach + gap + half.x())) *
      Eigen::AngleAxisd(angle, up);
}

bool apart(const World& world, const std::vector<Standing>& others, const Standing& thing) {
  constexpr double kGap = 5e-3;  // [m]
  const Eigen::Vector2d place = thing.T_world_thing.translation().head<2>();
  const Eigen::Vector2d nearest = place.cwiseMax(world.low.head<2>()).cwiseMin(world.high.head<2>());
  if ((place - nearest).norm() < thing.radius + kGap) return false;
  return std::all_of(others.begin(), others.end(), [&](const Standing& other) {
    return (place - other.T_world_thing.translation().head<2>()).norm() > thing.radius + other.radius + kGap;
  });
}

/// A place on the table beside or behind the body, where nothing is.
void putAnywhere(const World& world, const std::vector<Standing>& others, Draws* draws, Standing* thing) {
  do {
    // Not between the body and the camera.
    thing->T_world_thing.translation().x() = draws->between(-0.26, 0.26);
    thing->T_world_thing.translation().y() = draws->between(world.low.y(), world.high.y() + 0.16);
    thing->T_world_thing.linear() =
        Eigen::AngleAxisd(draws->between(0.0, 3.0), Eigen::Vector3d::UnitZ()).toRotationMatrix();
  } while (!apart(world, others, *thing));
}

/// A box between camera and body. Its edge cuts the view of the body in two, and it is high enough to hide
/// the half beyond the edge.
Standing screen(const World& world, Draws* draws) {
  const double side = draws->sign(), share = draws->between(0.47, 0.53);
  const double depth = draws->between(0.03, 0.06), back = world.low.y() - draws->between(0.01, 0.03);
  const Points from_eye = world.body.vertices.rowwise() - world.eye.transpose();
  const double way = back - world.eye.y();  // of a line of sight up to the box's back, along y
  std::vector<double> aside;
  for (Eigen::Index i = 0; i < from_eye.rows(); ++i)
    aside.push_back(side * from_eye(i, 0) / from_eye(i, 1) * (way - depth));
  std::vector<double> sorted = aside;
  std::sort(sorted.begin(), sorted.end());
  const double edge = sorted[static_cast<std::size_t>((1.0 - share) * static_cast<double>(sorted.size()))];
  const double outer = sorted.back() * way / (way - depth);
  double height = 0.0;
  for (Eigen::Index i = 0; i < from_eye.rows(); ++i) {
    if (aside[static_cast<std::size_t>(i)] >= edge)
      height = std::max(height, world.eye.z() + from_eye(i, 2) / from_eye(i, 1) * way);
  }
  Standing thing;
  const double width = outer - edge + draws->between(0.005, 0.02);
  thing.mesh = box({width, depth, height});
  thing.T_world_thing.translation() << world.eye.x() + side * (edge + 0.5 * width), back - 0.5 * depth,
      0.5 * height;
  thing.radius = 0.5 * std::hypot(width, depth);
  return thing;
}

}  // namespace

Play clutterPlay(const Stage& stage) {
  Draws draws(hash(stage.seed, 45));
  const World world = worldOf(stage);
  std::vector<Standing> things = {screen(world, &draws), drawnShape(&draws)};
  const double angle = draws.between(-0.2, 3.34);  // beside or behind the body, seen from the camera [rad]
  putBeside(world, angle, draws.below(2) * draws.between(0.0, 4e-3), &things.back());
  while (things.size() < 4) {
    Standing thing = drawnShape(&draws);
    putAnywhere(world, things, &draws, &thing);
    things.push_back(thing);
  }
  Play play;
  play.name = "clutter";
  play.duration_s = 3.0;
  play.repeats = false;
  // The sides of the body do not move into what touches them.
  play.deformation = shorteningOnTable(stage, {1.0, 0.8, 0.2}, 0.0);
  const Eigen::Isometry3d T_body_world = stage.T_camera_body.inverse() * stage.T_camera_world;
  for (const Standing& thing : things) {
    play.props.push_back(movedThing(stage, {thing.mesh, T_body_world * thing.T_world_thing},
                                    drawnLook(&draws),
                                    [](double) -> Eigen::Vector3d { return Eigen::Vector3d::Zero(); }));
  }
  return play;
}

}  // namespace softbody::virtual_camera
