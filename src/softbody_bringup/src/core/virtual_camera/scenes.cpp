#include <fmt/format.h>

#include <map>
#include <stdexcept>

#include "body_frame.h"
#include "plays.h"
#include "softbody_bringup/virtual_camera/scene.h"

namespace softbody::virtual_camera {
namespace {

const std::string kDoll = "doll_", kCut = "cut";

using PlayMaker = Play (*)(const Stage& stage);

const std::map<std::string, PlayMaker>& makers() {
  static const std::map<std::string, PlayMaker> makers = {
      {"still", stillPlay}, {"bend", bendPlay},   {"twist", twistPlay},
      {"push", pushPlay},   {"pull", pullPlay},   {"shake", shakePlay},
      {"leave", leavePlay}, {"press", pressPlay}, {"occlude", occludePlay}};
  return makers;
}

bool isDoll(const std::string& scene) { return scene.compare(0, kDoll.size(), kDoll) == 0; }

/// A scene of the body in its played frame.
Scene play(const std::string& name, const Stage& stage, const std::string& tool_file) {
  if (name == kCut) return cutScene(stage, readTool(tool_file));
  const auto found = makers().find(isDoll(name) ? name.substr(kDoll.size()) : name);
  if (found == makers().end()) {
    throw std::invalid_argument(
        fmt::format("there is no scene '{}'; known: {}", name, fmt::join(sceneNames(), ", ")));
  }
  Play play = found->second(stage);
  play.name = name;
  return perform(stage, play);
}

}  // namespace

std::vector<std::string> sceneNames() {
  std::vector<std::string> names;
  for (const auto& [name, maker] : makers()) names.push_back(name);
  for (const auto& [name, maker] : makers()) names.push_back(kDoll + name);
  names.push_back(kCut);
  return names;
}

std::string objectOf(const std::string& scene) { return isDoll(scene) ? "doll" : "sponge"; }

Scene makeScene(const std::string& name, const Body& body, std::uint64_t seed, const std::string& tool_file) {
  const BodyFrame frame = frameOf(body.rest.vertices);
  const Stage stage = makeStage({toPlayed(frame, body.rest.vertices), body.rest.triangles}, seed);
  return toOwn(frame, play(name, stage, tool_file), body);
}

}  // namespace softbody::virtual_camera
