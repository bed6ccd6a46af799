#include "softbody_recordings/image_folder/image_folder.h"

#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <set>
#include <stdexcept>

#include "image_folder/tum_folder.h"
#include "softbody_common/files/yaml_map_reader.h"

namespace fs = std::filesystem;

namespace softbody {
namespace {

template <typename... Arguments>
[[noreturn]] void fail(fmt::format_string<Arguments...> text, Arguments&&... arguments) {
  throw std::runtime_error(fmt::format(text, std::forward<Arguments>(arguments)...));
}

template <typename T>
T read(const YAML::Node& node, const char* key, const fs::path& file) {
  const YAML::Node value = node[key];
  if (!value) fail("{}: the key '{}' is missing", file.string(), key);
  try {
    return value.as<T>();
  } catch (const YAML::Exception&) {
    fail("{}: the key '{}' has an unexpected value: {}", file.string(), key, YAML::Dump(value));
  }
}

std::vector<std::string> unknownKeys(const YAML::Node& map, const std::set<std::string>& known,
                                     const fs::path& file) {
  std::vector<std::string> warnings;
  for (const auto& entry : map) {
    const std::string key = YamlMapReader::shown(entry.first);
    if (known.count(key) == 0) {
      warnings.push_back(fmt::format("{}: unknown key {} is ignored; known: {}", file.string(), key,
                                     fmt::join(known, ", ")));
    }
  }
  return warnings;
}

double depthUnitsPerMetre(const YAML::Node& depth, const fs::path& file) {
  if (!depth) return 1000.0;
  if (!depth.IsMap()) fail("{}: the key 'depth' must be a map of keys and values", file.string());
  if (depth["scale"]) {
    const auto scale = read<double>(depth, "scale", file);
    if (!(scale > 0.0) || !std::isfinite(scale))
      fail("{}: depth.scale is {}; it must be above 0", file.string(), scale);
    return scale;
  }
  const auto unit = depth["unit"] ? read<std::string>(depth, "unit", file) : std::string("mm");
  if (unit == "mm") return 1000.0;
  if (unit == "m") return 1.0;
  fail("{}: depth.unit is '{}'; allowed: mm, m", file.string(), unit);
}

/// The last run of digits in a file's name: the number of "frame-000012.color.png" is 12.
long fileNumber(const fs::path& file) {
  const std::string name = file.stem().string();
  const auto is_digit = [](unsigned char c) { return std::isdigit(c) != 0; };
  const auto last = std::find_if(name.rbegin(), name.rend(), is_digit);
  const auto first = std::find_if_not(last, name.rend(), is_digit);
  const std::string digits(first.base(), last.base());
  const bool timestamp = first != name.rend() && *first == '.' && std::next(first) != name.rend() &&
                         is_digit(static_cast<unsigned char>(*std::next(first)));
  if (digits.empty() || digits.size() > 9 || timestamp)
    fail("{}: the file's name must contain its frame number", file.string());
  return std::stol(digits);
}

bool isImage(const fs::path& file) {
  static const std::set<std::string> kExtensions{".png",  ".pgm", ".ppm", ".jpg",
                                                 ".jpeg", ".bmp", ".tif", ".tiff"};
  std::string extension = file.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return std::tolower(c); });
  return kExtensions.count(extension) != 0;
}

std::string gapWarning(const fs::path& directory, const std::map<long, fs::path>& numbered) {
  const long span = numbered.rbegin()->first - numbered.begin()->first + 1;
  const long missing = span - static_cast<long>(numbered.size());
  return missing == 0 ? ""
                      : fmt::format("{}: {} of {} numbers are missing; they count as dropped frames",
                                    directory.string(), missing, span);
}

std::vector<ImageFile> numberedFiles(const fs::path& directory, double rate_hz,
                                     std::vector<std::string>* warnings) {
  std::map<long, fs::path> numbered;
  for (const fs::directory_entry& entry : fs::directory_iterator(directory)) {
    if (!isImage(entry.path())) {
      warnings->push_back(fmt::format("{}: not an image, ignored", entry.path().string()));
      continue;
    }
    const auto [other, inserted] = numbered.emplace(fileNumber(entry.path()), entry.path());
    if (!inserted) fail("{} and {} have the same number", other->second.string(), entry.path().string());
  }
  if (numbered.empty())
    fail("{}: the folder has no image; it needs files like 000001.png", directory.string());
  if (const std::string gap = gapWarning(directory, numbered); !gap.empty()) warnings->push_back(gap);
  std::vector<ImageFile> files;
  files.reserve(numbered.size());
  for (const auto& [number, path] : numbered) {
    files.push_back({kFolderStart + std::llround(static_cast<double>(number) / rate_hz * 1e9), path});
  }
  return files;
}

cv::Mat readImage(const fs::path& file, const Pinhole& camera) {
  cv::Mat image = cv::imread(file.string(), cv::IMREAD_UNCHANGED);
  if (image.empty())
    fail("{}: cannot be read as an image; write it again as PNG, or remove it", file.string());
  if (image.cols != camera.width || image.rows != camera.height) {
    fail("{}: {}x{} pixels, but the camera has {}x{}", file.string(), image.cols, image.rows, camera.width,
         camera.height);
  }
  return image;
}

void checkDistortion(const FolderCamera& camera, const fs::path& file) {
  static const std::map<std::string, std::set<std::size_t>> kCounts{
      {"plumb_bob", {0, 4, 5}}, {"rational_polynomial", {8}}, {"equidistant", {4}}};
  const auto model = kCounts.find(camera.distortion_model);
  if (model == kCounts.end()) {
    fail("{}: distortion_model is '{}'; allowed: plumb_bob, rational_polynomial, equidistant", file.string(),
         camera.distortion_model);
  }
  const bool finite = std::all_of(camera.distortion.begin(), camera.distortion.end(),
                                  [](double x) { return std::isfinite(x); });
  if (!finite || model->second.count(camera.distortion.size()) == 0) {
    fail("{}: D must be {} finite numbers for distortion_model {}", file.string(),
         fmt::join(model->second, " or "), camera.distortion_model);
  }
}

void requireInside(const fs::path& directory, const fs::path& file) {
  if (!isInside(file, directory)) fail("{}: {}", directory.string(), outsideSentence(file, directory));
}

/// @param given the user named the camera file.
ImageFolder readTum(const fs::path& directory, const fs::path& camera, bool given) {
  ImageFolder folder = readTumFolder(directory);
  if (!given && !fs::exists(camera)) {
    folder.warnings.push_back(tumCameraWarning(directory));
    return folder;
  }
  const double units = folder.camera.depth_units_per_m;
  folder.camera = readFolderCamera(camera);
  folder.warnings.insert(folder.warnings.end(), folder.camera.warnings.begin(), folder.camera.warnings.end());
  if (!parseYamlFile(camera.string())["depth"]) folder.camera.depth_units_per_m = units;
  return folder;
}

ImageFolder readNumbered(const fs::path& directory, const fs::path& camera, double rate_hz) {
  for (const char* part : {"color", "depth"}) {
    if (!fs::is_directory(directory / part)) {
      fail("{}: expected color/, depth/ and camera.yaml, or rgb.txt and depth.txt; there is no {}/",
           directory.string(), part);
    }
  }
  ImageFolder folder;
  folder.camera = readFolderCamera(camera);
  folder.warnings = folder.camera.warnings;
  folder.color = numberedFiles(directory / "color", rate_hz, &folder.warnings);
  folder.depth = numberedFiles(directory / "depth", rate_hz, &folder.warnings);
  return folder;
}

}  // namespace

FolderCamera readFolderCamera(const fs::path& file) {
  YAML::Node root;
  try {
    root = parseYamlFile(file.string());
  } catch (const std::invalid_argument& error) {
    fail("{}", error.what());
  }
  if (!root.IsMap()) fail("{}: must be a map of keys and values", file.string());
  const auto K = read<std::vector<double>>(root, "K", file);
  if (K.size() != 9) fail("{}: K has {} numbers instead of 9", file.string(), K.size());
  FolderCamera result;
  result.camera = {
      read<int>(root, "image_width", file), read<int>(root, "image_height", file), K[0], K[4], K[2], K[5]};
  const bool usable = result.camera.width > 0 && result.camera.height > 0 && K[0] > 0.0 && K[4] > 0.0 &&
                      std::all_of(K.begin(), K.end(), [](double x) { return std::isfinite(x); });
  if (!usable)
    fail("{}: image_width, image_height and the focal lengths in K must be above 0", file.string());
  result.warnings = unknownKeys(
      root, {"image_width", "image_height", "K", "D", "distortion_model", "depth", "color", "fps"}, file);
  if (root["depth"].IsMap()) {
    const auto unknown = unknownKeys(root["depth"], {"scale", "unit", "format", "invalid"}, file);
    result.warnings.insert(result.warnings.end(), unknown.begin(), unknown.end());
  }
  if (root["D"]) result.distortion = read<std::vector<double>>(root, "D", file);
  if (result.distortion.size() == 8) result.distortion_model = "rational_polynomial";
  if (root["distortion_model"]) result.distortion_model = read<std::string>(root, "distortion_model", file);
  checkDistortion(result, file);
  result.depth_units_per_m = depthUnitsPerMetre(root["depth"], file);
  return result;
}

ImageFolder readImageFolder(const fs::path& directory, const fs::path& camera_file, double rate_hz,
                            FileScope scope) {
  if (!fs::is_directory(directory))
    fail("{}: there is no such folder; relative paths start in the current folder", directory.string());
  const bool is_tum = fs::exists(directory / "rgb.txt") && fs::exists(directory / "depth.txt");
  const fs::path camera = camera_file.empty() ? directory / "camera.yaml" : camera_file;
  if (scope == FileScope::kOwnFolder && camera_file.empty()) requireInside(directory, camera);
  ImageFolder folder =
      is_tum ? readTum(directory, camera, !camera_file.empty()) : readNumbered(directory, camera, rate_hz);
  if (scope == FileScope::kAnywhere) return folder;
  for (const ImageFile& image : folder.color) requireInside(directory, image.path);
  for (const ImageFile& image : folder.depth) requireInside(directory, image.path);
  return folder;
}

cv::Mat3b readColor(const fs::path& file, const Pinhole& camera) {
  cv::Mat image = readImage(file, camera);
  cv::Mat3b color;
  switch (image.type()) {
    case CV_8UC3:
      return image;
    case CV_8UC1:
      cv::cvtColor(image, color, cv::COLOR_GRAY2BGR);
      return color;
    case CV_8UC4:
      cv::cvtColor(image, color, cv::COLOR_BGRA2BGR);
      return color;
    default:
      fail("{}: is {}; colour must be 8-bit", file.string(), cv::typeToString(image.type()));
  }
}

cv::Mat readDepth(const fs::path& file, const FolderCamera& camera) {
  cv::Mat image = readImage(file, camera.camera);
  if (image.type() != CV_16UC1) {
    fail("{}: is {}; depth must be one channel of 16 bits (CV_16UC1)", file.string(),
         cv::typeToString(image.type()));
  }
  if (camera.depth_units_per_m == 1000.0) return image;
  cv::Mat metres;
  image.convertTo(metres, CV_32F, 1.0 / camera.depth_units_per_m);
  return metres;
}

}  // namespace softbody
