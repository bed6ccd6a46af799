#include "fuzz/feeds.h"

#include <algorithm>
#include <stdexcept>

namespace softbody::fuzz {

const std::vector<Feed>& feeds() {
  static const std::vector<Feed> kFeeds{
      {"surface_obj", [](std::string_view bytes) { giveSurface("obj", bytes); }},
      {"surface_off", [](std::string_view bytes) { giveSurface("off", bytes); }},
      {"surface_ply", [](std::string_view bytes) { giveSurface("ply", bytes); }},
      {"surface_stl", [](std::string_view bytes) { giveSurface("stl", bytes); }},
      {"tets_vtu", [](std::string_view bytes) { giveTets("vtu", bytes); }},
      {"tets_msh", [](std::string_view bytes) { giveTets("msh", bytes); }},
      {"tets_veg", [](std::string_view bytes) { giveTets("veg", bytes); }},
      {"tets_tet", [](std::string_view bytes) { giveTets("tet", bytes); }},
      {"tets_tetgen", giveTetGen},
      {"object_yaml", giveObjectYaml},
      {"tool_yaml", giveToolYaml},
      {"camera_yaml", giveCameraYaml},
      {"parameters", giveParameters}};
  return kFeeds;
}

const Feed& feed(std::string_view name) {
  const auto found =
      std::find_if(feeds().begin(), feeds().end(), [&](const Feed& feed) { return feed.name == name; });
  if (found == feeds().end()) throw std::out_of_range("no feed " + std::string(name));
  return *found;
}

}  // namespace softbody::fuzz
