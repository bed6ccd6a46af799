#include "texture/object_texture.h"

#include <yaml-cpp/yaml.h>

#include <stdexcept>
#include <vector>

#include "softbody_common/files/object_path.h"
#include "softbody_common/files/obj_materials.h"
#include "softbody_common/files/yaml_map_reader.h"

namespace softbody {
namespace fs = std::filesystem;

/// The rest of the first line that begins with a keyword, without spaces at its ends; empty if there is none.
std::string valueOf(const std::string& text, const std::string& keyword) {
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::string first, value;
    if (!(words >> first) || first != keyword) continue;
    std::getline(words >> std::ws, value);
    return value.substr(0, value.find_last_not_of(" \t\r") + 1);
  }
  return {};
}

/// A file that a line of another file names. Empty if there is no such line.
fs::path namedFile(const fs::path& file, const char* keyword, const fs::path& folder, FileScope scope) {
  const std::string name = valueOf(readFile(file), keyword);
  if (name.empty()) return {};
  fs::path named = file.parent_path() / name;
  if (scope == FileScope::kOwnFolder && !isInside(named, folder))
    throw std::invalid_argument(file.string() + ": " + outsideSentence(named, folder));
  return named;
}

}  // namespace

fs::path textureImageOf(const fs::path& given, FileScope scope) {
  const fs::path yaml = objectYamlAt(given.string());
fs::path textureImageOf(const fs::path& yaml, FileScope scope) {
  const YAML::Node root = parseYamlFile(yaml.string());
  YamlMapReader object(root["object"], yaml.string(), "object/");
  const fs::path mesh = object.file("visual_mesh", scope), folder = fs::absolute(yaml).parent_path();
  if (mesh.extension() != ".obj" && mesh.extension() != ".OBJ") return {};
  std::vector<std::string> warnings;
  const MaterialPictures pictures = picturesOf(fileReferences(mesh, {"mtllib"}), {},
                                               scope == FileScope::kOwnFolder ? folder : "", &warnings);
  if (!pictures.files.empty()) return pictures.files.front();
  if (!warnings.empty()) throw std::invalid_argument(warnings.front());
  return {};
}

}  // namespace softbody
