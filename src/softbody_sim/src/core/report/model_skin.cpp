#include "report/model_skin.h"

#include <fmt/format.h>

#include <algorithm>
#include <opencv2/imgcodecs.hpp>
#include <stdexcept>

#include "softbody_common/files/staged_output.h"
#include "softbody_sim/io/surface_files.h"

namespace softbody {
namespace {

/// A picture as the other tools and rviz read it.
struct Skin {
  std::string name;  ///< empty: no picture
  std::string bytes;
};

bool beginsWith(const std::string& bytes, std::string_view mark) {
  return bytes.compare(0, mark.size(), mark) == 0;
}

/// PNG and JPEG stay as they are; other formats become PNG.
Skin readSkin(const std::string& path, Warnings* warnings) {
  Skin skin{"visual.png", readFile(path)};
  if (beginsWith(skin.bytes, "\x89PNG")) return skin;
  if (beginsWith(skin.bytes, "\xff\xd8\xff")) return {"visual.jpg", skin.bytes};
  const cv::Mat image = cv::imread(path, cv::IMREAD_COLOR);
  std::vector<std::uint8_t> png;
  if (image.empty() || !cv::imencode(".png", image, png)) {
    warnings->push_back(
        fmt::format("{}: is not an image that OpenCV can read; the object has no picture", path));
    return {};
  }
  skin.bytes.assign(png.begin(), png.end());
  return skin;
}

/// The picture that most triangles show; empty if no triangle shows a picture.
std::string chosenPicture(const std::string& mesh, const SurfacePictures& pictures, Warnings* warnings) {
  std::vector<std::size_t> uses(pictures.files.size(), 0);
  for (const int picture : pictures.picture) {
    if (picture >= 0) ++uses[static_cast<std::size_t>(picture)];
  }
  const auto most = std::max_element(uses.begin(), uses.end());
  if (most == uses.end() || *most == 0) return {};
  const std::string& chosen = pictures.files[static_cast<std::size_t>(most - uses.begin())];
  if (std::count(uses.begin(), uses.end(), 0U) + 1 < static_cast<std::ptrdiff_t>(uses.size())) {
    warnings->push_back(fmt::format(
        "{}: has several pictures; only {} is kept, which is on {} of {} triangles; join them into one", mesh,
        chosen, *most, pictures.picture.size()));
  }
  return chosen;
}

}  // namespace

std::string writeSkin(const std::string& mesh, const std::filesystem::path& folder, Warnings* warnings) {
  Warnings already_given;
  const SurfaceFile file = readSurfaceFile(mesh, &already_given);
  const std::string picture =
      chosenPicture(mesh, surfacePictures(file, FileScope::kOwnFolder, warnings), warnings);
  if (picture.empty()) return {};
  if (file.texture_coordinates.rows() == 0) {
    warnings->push_back(fmt::format("{}: has no texture coordinates; {} is not kept", mesh, picture));
    return {};
  }
  const Skin skin = readSkin(picture, warnings);
  if (skin.name.empty()) return {};
  writeBytes(folder / skin.name, skin.bytes);
  writeBytes(folder / kSkinFiles[0], fmt::format("newmtl body\nKd 1 1 1\nmap_Kd {}\n", skin.name));
  return kSkinFiles[0];
}

}  // namespace softbody
