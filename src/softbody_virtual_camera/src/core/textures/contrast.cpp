#include "softbody_virtual_camera/textures/contrast.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace softbody::virtual_camera {
namespace {

const std::pair<const char*, float> kContrasts[] = {{"rich", 1.0f}, {"weak", 0.1f}, {"plain", 0.0f}};

Picture fadedPicture(const Picture& picture, float contrast) {
  const cv::Scalar mean = cv::mean(picture.front());
  Picture faded;
  for (const cv::Mat3b& level : picture) {
    cv::Mat3b image;
    cv::addWeighted(level, contrast, cv::Mat3b(level.size(), cv::Vec3b(mean[0], mean[1], mean[2])),
                    1.0 - contrast, 0.0, image);
    faded.push_back(image);
  }
  return faded;
}

}  // namespace

std::vector<std::string> textureNames() {
  std::vector<std::string> names;
  for (const auto& [name, contrast] : kContrasts) names.emplace_back(name);
  return names;
}

float contrastOf(const std::string& texture) {
  for (const auto& [name, contrast] : kContrasts) {
    if (texture == name) return contrast;
  }
  throw std::invalid_argument(
      fmt::format("there is no texture '{}'; known: {}", texture, fmt::join(textureNames(), ", ")));
}

Eigen::Vector3f plainColor() { return {0.55f, 0.55f, 0.50f}; }

Texture withContrast(const Texture& texture, float contrast) {
  if (contrast == 1.0f) return texture;
  if (contrast == 0.0f) return [](const Eigen::Vector3d&) { return plainColor(); };
  return [=](const Eigen::Vector3d& p) -> Eigen::Vector3f {
    return plainColor() + contrast * (texture(p) - plainColor());
  };
}

UvTexture withContrast(const UvTexture& skin, float contrast) {
  UvTexture faded = skin;
  if (contrast == 0.0f) {
    faded.picture.clear();
    faded.pictures.clear();
  }
  if (contrast == 1.0f) return faded;
  for (Picture& picture : faded.pictures) picture = fadedPicture(picture, contrast);
  return faded;
}

}  // namespace softbody::virtual_camera
