#include "softbody_common/images/object_texture.h"

#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

#include <opencv2/imgcodecs.hpp>
#include <stdexcept>
#include <vector>

#include "softbody_common/files/obj_materials.h"
#include "softbody_common/files/object_path.h"
#include "softbody_common/files/text_reader.h"
#include "softbody_common/files/yaml_map_reader.h"
#include "softbody_common/geometry/plausibility.h"
#include "softbody_common/images/encoded_image.h"

namespace softbody {
namespace fs = std::filesystem;
namespace {

/// Each image once, in the order of the materials.
std::vector<std::string> textureImagesOf(const fs::path& given, FileScope scope) {
  const fs::path yaml = objectYamlAt(given.string());
  const YAML::Node root = parseYamlFile(yaml.string());
  YamlMapReader object(root["object"], yaml.string(), "object/");
  const fs::path mesh = object.file("visual_mesh", scope), folder = fs::absolute(yaml).parent_path();
  if (extensionOf(mesh.string()) != "obj") return {};
  std::vector<std::string> warnings;
  const MaterialPictures pictures = picturesOf(fileReferences(mesh, {"mtllib"}), {},
                                               scope == FileScope::kOwnFolder ? folder : "", &warnings);
  if (pictures.files.empty() && !warnings.empty()) throw std::invalid_argument(warnings.front());
  return pictures.files;
}

cv::Mat3b readTexture(const std::string& path) {
  const std::string bytes = readFile(path);
  const auto* data = reinterpret_cast<const std::uint8_t*>(bytes.data());
  const auto header = readEncodedImageHeader(data, bytes.size());
  if (!header)
    throw std::invalid_argument(
        fmt::format("{}: is no whole PNG or JPEG; save it again as PNG, or let prepare_model do it", path));
  if (isTooLarge(*header))
    throw std::invalid_argument(
        fmt::format("{}: {}x{} pixels; allowed: up to {} a side and {} in all; make the image smaller", path,
                    header->width, header->height, kLargestImageSide, kMostEncodedPixels));
  cv::Mat image;
  try {
    const cv::Mat1b encoded(1, static_cast<int>(bytes.size()), const_cast<std::uint8_t*>(data));
    image = cv::imdecode(encoded, cv::IMREAD_COLOR | cv::IMREAD_IGNORE_ORIENTATION);
  } catch (const cv::Exception&) {  // the sentence is ours
  }
  if (image.empty())
    throw std::invalid_argument(fmt::format("{}: the image is damaged; save it again as PNG", path));
  return image;
}

}  // namespace

fs::path textureImageOf(const fs::path& yaml, FileScope scope) {
  const std::vector<std::string> images = textureImagesOf(yaml, scope);
  return images.empty() ? fs::path() : fs::path(images.front());
}

cv::Mat3b readObjectTexture(const fs::path& yaml, FileScope scope) {
  const std::vector<std::string> images = textureImagesOf(yaml, scope);
  if (images.size() > 1)
    throw std::invalid_argument(fmt::format(
        "{}: its visual mesh has {} images, {} and others; join them into one, or let prepare_model keep one",
        yaml.string(), images.size(), images.front()));
  return images.empty() ? cv::Mat3b() : readTexture(images.front());
}

}  // namespace softbody
