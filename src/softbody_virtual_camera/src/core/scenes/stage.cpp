#include "scenes/stage.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "softbody_common/statistics/random.h"
#include "softbody_virtual_camera/bodies/shapes.h"
#include "textures/body_paint.h"

namespace softbody::virtual_camera {
namespace {

constexpr double kDegree = 3.14159265358979323846 / 180.0;
constexpr double kYaw = 25.0 * kDegree;  // of the body

/// Optical frame of a camera at `eye` that looks at `target`, its x axis level.
Eigen::Isometry3d lookAt(const Eigen::Vector3d& eye, const Eigen::Vector3d& target) {
  const Eigen::Vector3d forward = (target - eye).normalized();
  const Eigen::Vector3d right = forward.cross(Eigen::Vector3d::UnitZ()).normalized();
  Eigen::Isometry3d T_world_camera = Eigen::Isometry3d::Identity();
  T_world_camera.linear() << right, forward.cross(right), forward;
  T_world_camera.translation() = eye;
  return T_world_camera.inverse();
}

/// Height of the body's origin above the table [m]; unless it lies there, with space to bend.
double heightOf(const TriangleMesh& body, const Place& place) {
  constexpr double kLeast = 0.08;
  const double below = -body.vertices.col(2).minCoeff();
  return place.on_table ? below : std::max(kLeast, place.clearance_m + below);
}

/// The texture of the table around a body that lies on it: darker below the body, and beside it where the
/// light does not come. All in the world's frame.
Texture withShadow(const Texture& texture, const TriangleMesh& body, const Eigen::Vector3d& to_light) {
  constexpr double kSoft = 0.025;  // [m]
  constexpr float kDarkest = 0.6f;
  const Eigen::Vector3d low = body.vertices.colwise().minCoeff(), high = body.vertices.colwise().maxCoeff();
  const Eigen::Vector3d half = 0.5 * (high - low);
  const Eigen::Vector3d aside = -half.z() / to_light.z() * to_light;
  return [=](const Eigen::Vector3d& p) -> Eigen::Vector3f {
    const Eigen::Vector3d from_middle = Eigen::AngleAxisd(-kYaw, Eigen::Vector3d::UnitZ()) * (p - aside);
    const Eigen::Vector2d beyond = (from_middle.cwiseAbs() - half).head<2>().cwiseMax(0.0);
    return (1.0f - kDarkest * static_cast<float>(std::exp(-beyond.squaredNorm() / (kSoft * kSoft)))) *
           texture(p);
  };
}

}  // namespace

Stage makeStage(const Body& body, std::uint64_t seed, const BodyPaint& paint, const Place& place) {
  constexpr double kElevation = 42.0 * kDegree;
  const Eigen::Vector3d center(0.0, 0.0, heightOf(body.rest, place));
  const Eigen::Vector3d to_light = Eigen::Vector3d(-0.45, -0.35, 0.82).normalized();
  const Eigen::Vector3d eye =
      center + place.distance_m * Eigen::Vector3d(0.0, -std::cos(kElevation), std::sin(kElevation));
  Stage stage;
  stage.T_camera_world = lookAt(eye, center);
  stage.T_camera_body =
      stage.T_camera_world * Eigen::Translation3d(center) * Eigen::AngleAxisd(kYaw, Eigen::Vector3d::UnitZ());
  const TriangleMesh table = rectangle({-0.8, -0.3, 0.0}, {1.6, 0.0, 0.0}, {0.0, 0.8, 0.0});
  const TriangleMesh wall = rectangle({-0.8, 0.5, 0.0}, {1.6, 0.0, 0.0}, {0.0, 0.0, 0.8});
  const Texture wood = woodTexture(hash(seed, 2));
  stage.actors = {{body.rest, textureOf(paint, hash(seed, 1))},
                  {table, place.on_table ? withShadow(wood, body.rest, to_light) : wood, 1.6e-3},
                  {wall, plasterTexture(hash(seed, 3)), 4.0e-3}};
  stage.elasticity = body.elasticity;
  stage.paint = paint;
  stage.seed = seed;
  stage.actors[0].skin = withContrast(body.skin, paint.contrast);
  for (const std::size_t around : {1u, 2u})
    stage.actors[around].still = stage.actors[around].background = true;
  const Eigen::Matrix3d R_camera_world = stage.T_camera_world.linear();
  stage.lights.to_main = R_camera_world * to_light;
  if (paint.contrast == 0.0f) {
    stage.lights.to_fill = R_camera_world * Eigen::Vector3d(0.70, -0.65, 0.30).normalized();
    stage.lights.ambient = stage.lights.fill = 0.25f;
  }
  return stage;
}

namespace {

std::vector<LinkPose> named(const Robot& robot, const std::vector<Eigen::Isometry3d>& poses) {
  std::vector<LinkPose> links;
  for (std::size_t i = 0; i < poses.size(); ++i) links.push_back({robot.at(i).name, poses[i]});
  return links;
}

}  // namespace

Prop rigidProp(const Actor& actor, const std::function<Eigen::Isometry3d(double t)>& T_camera_prop) {
  return {actor, [=](double t) { return transformed(T_camera_prop(t), actor.rest.vertices); }};
}

Scene perform(const Stage& stage, const Play& play) {
  Scene scene;
  scene.name = play.name;
  scene.duration_s = play.duration_s;
  scene.T_camera_world = stage.T_camera_world;
  scene.actors = stage.actors;
  for (const Prop& prop : play.props) scene.actors.push_back(prop.actor);
  scene.hands = play.props.size();
  scene.color_noise = play.color_noise;
  scene.robot = play.robot;
  scene.material = play.material;
  scene.has_weight = play.has_weight;
  if (play.T_camera_second) scene.second = stage.actors.size();
  const Points table = transformed(stage.T_camera_world, stage.actors.at(1).rest.vertices);
  const Points wall = transformed(stage.T_camera_world, stage.actors.at(2).rest.vertices);
  scene.state = [=, rest = stage.actors.at(0).rest.vertices](double time) {
    const double t = play.repeats ? std::fmod(time, play.duration_s) : time;
    Points body = play.shape ? play.shape(t) : rest;
    if (play.deformation) {
      for (Eigen::Index i = 0; i < rest.rows(); ++i) body.row(i) = play.deformation(rest.row(i), t);
    }
    SceneState state;
    state.lights = stage.lights;
    if (play.gripper) state.gripper = play.gripper(t);
    if (play.brightness) state.brightness = play.brightness(t);
    state.T_camera_body = play.T_camera_body ? play.T_camera_body(t) : stage.T_camera_body;
    state.vertices = {transformed(state.T_camera_body, body), table, wall};
    if (play.T_camera_second) state.T_camera_second = play.T_camera_second(t);
    if (play.links) state.links = named(play.robot, play.links(t));
    if (play.frames) state.frames = play.frames(t);
    if (play.wrenches) state.wrenches = play.wrenches(t);
    if (play.forces) state.forces = transformed(state.T_camera_body, play.forces(t));
    for (const Prop& prop : play.props) {
      state.vertices.push_back(prop.vertices(t));
    }
    return state;
  };
  return scene;
}

}  // namespace softbody::virtual_camera
