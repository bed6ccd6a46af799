#include "textures/body_paint.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace softbody::virtual_camera {
namespace {

const std::pair<const char*, BodyPaint> kPaints[] = {{"rich", {cellTexture, 1.0f}},
                                                     {"weak", {cellTexture, 0.1f}},
                                                     {"plain", {cellTexture, 0.0f}},
                                                     {"sponge", {spongeTexture, 1.0f}}};

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
  for (const auto& [name, paint] : kPaints) names.emplace_back(name);
  return names;
}

BodyPaint paintOf(const std::string& texture) {
  for (const auto& [name, paint] : kPaints) {
    if (texture == name) return paint;
  }
  throw std::invalid_argument(
      fmt::format("there is no texture '{}'; known: {}", texture, fmt::join(textureNames(), ", ")));
}

Texture textureOf(const BodyPaint& paint, std::uint64_t seed) {
  return withContrast(paint.pattern(seed), paint.contrast);
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
