#include "catalog/make_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <stdexcept>

#include "cluttered/arm_play.h"
#include "cluttered/clutter_play.h"
#include "cluttered/held_play.h"
#include "cluttered/neighbour_plays.h"
#include "cluttered/two_bodies_play.h"
#include "elastic/grip_play.h"
#include "elastic/hanging_plays.h"
#include "elastic/held_plays.h"
#include "elastic/pressing_plays.h"
#include "elastic/stamp_play.h"
#include "scenes/body_frame.h"
#include "scenes/cut_scenes.h"
#include "scenes/grasp.h"
#include "scenes/plays.h"
#include "scenes/plays_with_hands.h"
#include "scenes/tear_scene.h"
#include "textures/body_paint.h"

namespace softbody::virtual_camera {
namespace {

const std::string kDoll = "doll_";

using PlayMaker = Play (*)(const Stage& stage);
/// A scene without a tool.
struct Setting {
  PlayMaker play;
  Place place = {};
  bool for_doll = true;  ///< the solvers of some scenes would take too long for it
};

using CutMaker = Scene (*)(const Stage& stage, const Tool& tool);

const std::map<std::string, Setting>& plays() {
  static const std::map<std::string, Setting> settings = {
      {"still", {stillPlay}},
      {"bend", {bendPlay}},
      {"twist", {twistPlay}},
      {"push", {pushPlay}},
      {"pull", {pullPlay}},
      {"shake", {shakePlay}},
      {"rigid", {rigidPlay}},
      {"fast", {fastPlay}},
      {"roll", {rollPlay}},
      {"dim", {dimPlay}},
      {"far", {farPlay, {0.9}}},
      {"leave", {leavePlay}},
      {"press", {pressPlay}},
      {"occlude", {occludePlay}},
      {"touch", {touchPlay}},
      {"squeeze", {squeezePlay}},
      {"grasp", {graspPlay}},
      {"table", {tablePlay, {kNear_m, true}}},
      {"grip", {gripPlay}},
      {"stamp", {stampPlay, {kNear_m, true}}},
      {"sag", {sagPlay, {kNear_m, false, 0.07}, false}},
      {"swing", {swingPlay, {kNear_m, false, 0.07}, false}},
      {"plates", {platesPlay, {}, false}},
      {"pull_held", {pullHeldPlay, {}, false}},
      {"bend_held", {bendHeldPlay, {}, false}},
      {"twist_held", {twistHeldPlay, {}, false}},
      {"push_held", {pushHeldPlay, {}, false}},
      {"press_held", {pressHeldPlay, {}, false}},
      {"neighbour", {neighbourPlay, {kNear_m, true}}},
      {"twin", {twinPlay, {kNear_m, true}}},
      {"stack", {stackPlay, {kNear_m, true}}},
      {"clutter", {clutterPlay, {kNear_m, true}}},
      {"held", {heldPlay}},
      {"two_bodies", {twoBodiesPlay, {0.75}}},
      {"arm", {armPlay}}};
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

std::string withoutPrefix(const std::string& scene) {
  return isDoll(scene) ? scene.substr(kDoll.size()) : scene;
}

}  // namespace

std::vector<std::string> sceneNames() {
  std::vector<std::string> names;
  for (const std::string& prefix : {std::string(), kDoll}) {
    for (const auto& [name, setting] : plays()) {
      if (prefix.empty() || setting.for_doll) names.push_back(prefix + name);
    }
    for (const auto& [name, maker] : cuts()) names.push_back(prefix + name);
    for (const std::string& name : scanNames()) names.push_back(prefix + name);
  }
  return names;
}

bool isScan(const std::string& scene) {
  const std::vector<std::string> names = scanNames();
  return std::find(names.begin(), names.end(), withoutPrefix(scene)) != names.end();
}

std::string objectOf(const std::string& scene) { return isDoll(scene) ? "doll" : "sponge"; }

std::string secondObjectOf(const std::string& scene) {
  const std::string play = "two_bodies";
  if (scene == play) return "doll";
  return scene == kDoll + play ? "sponge" : "";
}

Scene makeScene(const std::string& name, const Body& body, std::uint64_t seed, const std::string& tool_file,
                const std::string& texture, const std::optional<Body>& second, const ScanOptions& scan) {
  const std::string plain = withoutPrefix(name);
  if (isScan(name)) {
    Scene scene = scanScene(plain, body, seed, paintOf(texture), scan);
    scene.name = name;
    return scene;
  }
  const auto play = plays().find(plain);
  const auto cut = cuts().find(plain);
  const bool known = play != plays().end() ? play->second.for_doll || !isDoll(name) : cut != cuts().end();
  if (!known) {
    throw std::invalid_argument(
        fmt::format("there is no scene '{}'; known: {}", name, fmt::join(sceneNames(), ", ")));
  }
  const BodyFrame frame = frameOf(body.rest.vertices);
  Stage stage =
      makeStage({{toSceneFrame(frame, body.rest.vertices), body.rest.triangles}, body.skin, body.elasticity},
                seed, paintOf(texture), play != plays().end() ? play->second.place : Place());
  stage.gravity_m_s2 /= frame.scale;
  if (auto& density = stage.elasticity.density_kg_m3) *density *= frame.scale * frame.scale;
  if (second)
    stage.second =
        Body{{toSceneFrame(frameOf(second->rest.vertices), second->rest.vertices), second->rest.triangles},
             second->skin,
             second->elasticity};
  Scene scene = play != plays().end() ? perform(stage, play->second.play(stage))
                                      : cut->second(stage, scaled(readTool(tool_file), 1.0 / frame.scale));
  scene.name = name;
  return toBodyFrame(frame, scene, body.rest);
}

}  // namespace softbody::virtual_camera
