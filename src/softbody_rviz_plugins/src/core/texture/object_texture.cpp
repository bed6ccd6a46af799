#include "texture/object_texture.h"

#include <yaml-cpp/yaml.h>

#include <stdexcept>
#include <vector>

#include "softbody_common/files/obj_materials.h"
#include "softbody_common/files/object_path.h"
#include "softbody_common/files/yaml_map_reader.h"

namespace softbody {
namespace fs = std::filesystem;

fs::path textureImageOf(const fs::path& given, FileScope scope) {
  const fs::path yaml = objectYamlAt(given.string());
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
