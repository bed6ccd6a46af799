#include "softbody_common/files/object_path.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <set>
#include <stdexcept>

namespace softbody {
namespace {

namespace fs = std::filesystem;

constexpr char kName[] = "object.yaml";  // as prepare_model writes it

bool isMesh(const fs::path& file) {
  static const std::set<std::string> kExtensions{".obj",  ".ply", ".stl", ".off", ".vtu",  ".msh",
                                                 ".node", ".ele", ".veg", ".vtk", ".mesh", ".gltf",
                                                 ".glb",  ".dae", ".fbx", ".3mf"};
  std::string extension = file.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return kExtensions.count(extension) > 0;
}

}  // namespace

std::string objectYamlAt(const std::string& given) {
  const fs::path path(given);
  std::error_code unknown;
  const bool is_folder = fs::is_directory(path, unknown);
  const fs::path folder = is_folder ? path : path.parent_path();
  const bool has_yaml = fs::is_regular_file(folder / kName, unknown);
  if (is_folder && has_yaml) return (folder / kName).string();
  if (is_folder)
    throw std::invalid_argument(
        fmt::format("{}: this folder has no {}; rosrun softbody_sim prepare_model MESH --output FOLDER makes "
                    "a folder that has one",
                    given, kName));
  if (!isMesh(path)) return given;
  const std::string otherwise = fmt::format(
      "make one with rosrun softbody_sim prepare_model {} --output my_object, and give "
      "my_object/{}",
      given, kName);
  throw std::invalid_argument(fmt::format(
      "{}: this is a mesh, but the object's YAML is needed: {}", given,
      has_yaml ? fmt::format("give {}, which is beside it, or {}", (folder / kName).string(), otherwise)
               : otherwise));
}

}  // namespace softbody
