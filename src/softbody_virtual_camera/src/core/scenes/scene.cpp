#include "softbody_virtual_camera/scenes/scene.h"

#include <fmt/format.h>

#include <map>
#include <stdexcept>
#include <utility>

#include "scenes/body_frame.h"
#include "scenes/cut_scenes.h"
#include "scenes/grasp.h"
#include "scenes/plays.h"
#include "scenes/plays_with_hands.h"
#include "scenes/solid_plays.h"
#include "scenes/tear_scene.h"
#include "softbody_virtual_camera/textures/contrast.h"

namespace softbody::virtual_camera {
namespace {

const std::string kDoll = "doll_";

using PlayMaker = Play (*)(const Stage& stage);
/// A scene without a tool.
struct Setting {
  PlayMaker play;
  Place place = {};
};

using CutMaker = Scene (*)(const Stage& stage, const Tool& tool);

const std::map<std::string, Setting>& plays() {
  static const std::map<std::string, Setting> settings = {
      {"still", {stillPlay}},    {"bend", {bendPlay}},
      {"twist", {twistPlay}},    {"push", {pushPlay}},
      {"pull", {pullPlay}},      {"shake", {shakePlay}},
      {"rigid", {rigidPlay}},    {"fast", {fastPlay}},
      {"roll", {rollPlay}},      {"dim", {dimPlay}},
      {"far", {farPlay, {0.9}}}, {"leave", {leavePlay}},
      {"press", {pressPlay}},    {"occlude", {occludePlay}},
      {"touch", {touchPlay}},    {"squeeze", {squeezePlay}},
      {"grasp", {graspPlay}},    {"table", {tablePlay, {kNear_m, true}}},
      {"grip", {gripPlay}},      {"stamp", {stampPlay, {kNear_m, true}}}};
  return settings;
}

const std::map<std::string, CutMaker>& cuts() {
  static const std::map<std::string, CutMaker> makers = {
      {"cut", cutScene},
      {"cut-cross", cutCrossScene},
      {"cut-partial", cutPartialScene},
      {"tear", [](const Stage& stage, const Tool&) { return tearScene(stage); }}};
  return makers;
}

bool isDoll(const std::string& scene) { return scene.compare(0, kDoll.size(), kDoll) == 0; }

}  // namespace

GripperState transformed(const Eigen::Isometry3d& T, GripperState gripper) {
  gripper.T_camera_gripper = T * gripper.T_camera_gripper;
  for (Eigen::Isometry3d& finger : gripper.T_camera_fingers) finger = T * finger;
  return gripper;
}

GripperState scaled(GripperState gripper, double factor) {
  gripper.T_camera_gripper.translation() *= factor;
  for (Eigen::Isometry3d& finger : gripper.T_camera_fingers) finger.translation() *= factor;
  return gripper;
}

std::vector<SurfaceForce> transformed(const Eigen::Isometry3d& T, std::vector<SurfaceForce> forces) {
  for (SurfaceForce& force : forces) {
    force.place = T * force.place;
    force.normal = T.linear() * force.normal;
    force.force = T.linear() * force.force;
  }
  return forces;
}

Scene withoutHands(Scene scene) {
  const std::size_t kept = scene.actors.size() - std::exchange(scene.hands, 0);
  scene.actors.resize(kept);
  scene.state = [kept, with_hands = std::move(scene.state)](double t) {
    SceneState state = with_hands(t);
    state.vertices.resize(kept);
    return state;
  };
  return scene;
}

std::vector<std::string> sceneNames() {
  std::vector<std::string> names;
  for (const std::string& prefix : {std::string(), kDoll}) {
    for (const auto& [name, maker] : plays()) names.push_back(prefix + name);
    for (const auto& [name, maker] : cuts()) names.push_back(prefix + name);
  }
  return names;
}

std::string objectOf(const std::string& scene) { return isDoll(scene) ? "doll" : "sponge"; }

Scene makeScene(const std::string& name, const Body& body, std::uint64_t seed, const std::string& tool_file,
                const std::string& texture) {
  const std::string plain = isDoll(name) ? name.substr(kDoll.size()) : name;
  const auto play = plays().find(plain);
  const auto cut = cuts().find(plain);
  if (play == plays().end() && cut == cuts().end()) {
    throw std::invalid_argument(
        fmt::format("there is no scene '{}'; known: {}", name, fmt::join(sceneNames(), ", ")));
  }
  const BodyFrame frame = frameOf(body.rest.vertices);
  const Stage stage =
      makeStage({{toSceneFrame(frame, body.rest.vertices), body.rest.triangles}, body.skin, body.elasticity},
                seed, contrastOf(texture), play != plays().end() ? play->second.place : Place());
  Scene scene = play != plays().end() ? perform(stage, play->second.play(stage))
                                      : cut->second(stage, scaled(readTool(tool_file), 1.0 / frame.scale));
  scene.name = name;
  return toBodyFrame(frame, scene, body.rest);
}

}  // namespace softbody::virtual_camera
