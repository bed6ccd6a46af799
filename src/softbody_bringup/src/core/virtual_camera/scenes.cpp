#include <fmt/format.h>

#include <map>
#include <stdexcept>

#include "plays.h"
#include "softbody_bringup/virtual_camera/scene.h"

namespace softbody::virtual_camera {
namespace {

using PlayMaker = Play (*)(const Stage& stage);

const std::map<std::string, PlayMaker>& makers() {
  static const std::map<std::string, PlayMaker> makers = {
      {"still", stillPlay}, {"bend", bendPlay},   {"twist", twistPlay},
      {"push", pushPlay},   {"pull", pullPlay},   {"shake", shakePlay},
      {"leave", leavePlay}, {"press", pressPlay}, {"occlude", occludePlay}};
  return makers;
}

}  // namespace

std::vector<std::string> sceneNames() {
  std::vector<std::string> names;
  for (const auto& [name, maker] : makers()) names.push_back(name);
  return names;
}

Scene makeScene(const std::string& name, const TriangleMesh& body, std::uint64_t seed) {
  const auto found = makers().find(name);
  if (found == makers().end()) {
    throw std::invalid_argument(
        fmt::format("there is no scene '{}'; known: {}", name, fmt::join(sceneNames(), ", ")));
  }
  const Stage stage = makeStage(body, seed);
  return perform(stage, found->second(stage));
}

}  // namespace softbody::virtual_camera
