#include "scanned/scan_scene.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "scanned/desk.h"
#include "scanned/hand_held.h"
#include "scanned/passing_hands.h"
#include "scenes/body_frame.h"
#include "softbody_common/statistics/random.h"
#include "softbody_virtual_camera/bodies/shapes.h"
#include "textures/body_paint.h"

namespace softbody::virtual_camera {
namespace {

constexpr double kUsualDistance = 0.45;  // [m]

/// The body on the table: its longest axis along y, as the paper's; its lowest point at z = 0.
Eigen::Isometry3d lyingPose(const Points& rest, bool flipped) {
  constexpr double kYaw = 1.7, kFlippedYaw = 1.2;  // [rad] about the vertical
  const Eigen::Vector2d place = flipped ? Eigen::Vector2d(0.006, -0.010) : Eigen::Vector2d::Zero();  // [m]
  Eigen::Isometry3d T_world_body = Eigen::Isometry3d::Identity();
  T_world_body.linear() = Eigen::AngleAxisd(flipped ? kFlippedYaw : kYaw, Eigen::Vector3d::UnitZ()) *
                          Eigen::AngleAxisd(flipped ? M_PI : 0.0, Eigen::Vector3d::UnitX()) *
                          frameOf(rest).turn;
  const Points turned = transformed(T_world_body, rest);
  T_world_body.translation() << place - middleOf(turned).head<2>(), -turned.col(2).minCoeff();
  return T_world_body;
}

/// Lights that stay in the world.
struct RoomLights {
  Eigen::Vector3d to_main = Eigen::Vector3d(-0.45, -0.35, 0.82).normalized(),
                  to_fill = Eigen::Vector3d::Zero();
  float ambient = 0.40f, fill = 0.0f;
};

RoomLights roomLights(const BodyPaint& paint) {
  if (paint.contrast > 0.0f) return {};
  RoomLights lights;
  lights.to_fill = Eigen::Vector3d(0.70, -0.65, 0.30).normalized();
  lights.ambient = lights.fill = 0.25f;
  return lights;
}

Lights seen(const RoomLights& lights, const Eigen::Isometry3d& T_camera_world) {
  return {T_camera_world.linear() * lights.to_main, T_camera_world.linear() * lights.to_fill, lights.ambient,
          lights.fill};
}

/// All that the state of a scan depends on, besides the time.
struct Scan {
  CameraWay way;
  Eigen::Isometry3d T_world_body;  ///< at the start
  RoomLights lights;
  std::vector<Points> around;   ///< vertices of table, walls and things, in the world
  std::optional<Points> sheet;  ///< vertices, in the sheet's frame
  std::vector<PassingHand> hands;
  bool turns = false, camera_tf = false;
};

/// The sheet and the body on it.
Eigen::Isometry3d turntablePose(const Scan& scan, double t) {
  constexpr double kTurns = 2.0 * M_PI * 730.0 / 360.0;  // a little more than two
  return Eigen::Isometry3d(
      Eigen::AngleAxisd(scan.turns ? kTurns * t / scan.way.duration_s : 0.0, Eigen::Vector3d::UnitZ()));
}

Eigen::Isometry3d cameraPose(const Scan& scan, double t) {
  return scan.turns ? standingCamera(scan.way, t) : walkingCamera(scan.way, t);
}

SceneState stateOf(const Scan& scan, const Points& rest, double t) {
  const Eigen::Isometry3d T_world_camera = cameraPose(scan, t);
  const Eigen::Isometry3d T_camera_world = T_world_camera.inverse();
  const Eigen::Isometry3d T_camera_sheet = T_camera_world * turntablePose(scan, t);
  SceneState state;
  state.T_camera_body = T_camera_sheet * scan.T_world_body;
  state.lights = seen(scan.lights, T_camera_world);
  state.vertices = {transformed(state.T_camera_body, rest)};
  for (const Points& vertices : scan.around) state.vertices.push_back(transformed(T_camera_world, vertices));
  if (scan.sheet) state.vertices.push_back(transformed(T_camera_sheet, *scan.sheet));
  for (const PassingHand& hand : scan.hands)
    state.vertices.push_back(transformed(T_camera_world * hand.T_world_hand(t), hand.actor.rest.vertices));
  if (scan.camera_tf) state.T_world_camera = T_world_camera;
  return state;
}

CameraWay wayAround(const Points& lying, std::uint64_t seed, bool jerks) {
  const double length = (lying.colwise().maxCoeff() - lying.colwise().minCoeff()).maxCoeff();
  CameraWay way;
  way.distance_m = 0.25 + 1.2 * length;
  way.target = middleOf(lying);
  way.jerks = jerks;
  way.seed = hash(seed, 6);
  return way;
}

/// The desk, and the sheet or, on a turntable without one, empty paper.
void addSurroundings(const TriangleMesh& lying, std::uint64_t seed, const ScanOptions& options, Scene* scene,
                     Scan* scan) {
  constexpr double kPaper = 0.3e-3;  // [m] of the paper, with what air is below it
  const ContactShadow shadow(lying);
  const bool paper = options.sheet || scan->turns;
  for (const Actor& actor : deskActors(scan->way.distance_m / kUsualDistance, paper ? -kPaper : 0.0,
                                       scan->turns ? nullptr : &shadow, seed)) {
    scan->around.push_back(actor.rest.vertices);
    scene->actors.push_back(actor);
  }
  if (!paper) return;
  scene->actors.push_back(sheetActor(options.sheet.value_or(ToolDescription{}), shadow));
  scan->sheet = scene->actors.back().rest.vertices;
}

}  // namespace

std::vector<std::string> scanNames() { return {"flip", "turntable", "walk", "walk_hand"}; }

Eigen::Vector3d middleOf(const Points& points) {
  return 0.5 * (points.colwise().minCoeff() + points.colwise().maxCoeff()).transpose();
}

Scene scanScene(const std::string& name, const Body& body, std::uint64_t seed, const BodyPaint& paint,
                const ScanOptions& options) {
  Scan scan;
  scan.turns = name == "turntable";
  if (scan.turns && options.jerks)
    throw std::invalid_argument(
        "jerks: the camera before the turntable stands still; leave them out, or take the scene walk");
  scan.T_world_body = lyingPose(body.rest.vertices, name == "flip");
  const TriangleMesh lying{transformed(scan.T_world_body, body.rest.vertices), body.rest.triangles};
  scan.way = wayAround(lying.vertices, seed, options.jerks);
  scan.lights = roomLights(paint);
  scan.camera_tf = options.camera_tf;
  const double beside = lying.vertices.col(0).maxCoeff() + 0.05;  // [m]
  if (name == "walk_hand") scan.hands = passingHands(scan.way, {beside, middleOf(lying.vertices).y(), 0.0});
  Scene scene;
  scene.name = name;
  scene.duration_s = scan.way.duration_s;
  scene.actors = {{body.rest, textureOf(paint, hash(seed, 1))}};
  scene.actors[0].skin = withContrast(body.skin, paint.contrast);
  addSurroundings(lying, seed, options, &scene, &scan);
  for (const PassingHand& hand : scan.hands) scene.actors.push_back(hand.actor);
  scene.hands = scan.hands.size();
  scene.state = [scan, rest = body.rest.vertices](double t) { return stateOf(scan, rest, t); };
  scene.T_camera_world = cameraPose(scan, 0.0).inverse();
  return scene;
}

}  // namespace softbody::virtual_camera
