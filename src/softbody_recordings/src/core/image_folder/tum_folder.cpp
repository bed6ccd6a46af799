#include "image_folder/tum_folder.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <tuple>

namespace fs = std::filesystem;

namespace softbody {
namespace {

constexpr Nanoseconds kPairTolerance = 20'000'000;  // as the benchmark's associate.py

FolderCamera freiburg1() {
  FolderCamera camera;
  camera.camera = {640, 480, 517.3, 516.5, 318.6, 255.3};
  camera.distortion = {0.2624, -0.9531, -0.0054, 0.0026, 1.1633};
  camera.depth_units_per_m = 5000.0;
  return camera;
}

std::vector<ImageFile> readList(const fs::path& list) {
  std::ifstream input(list);
  if (!input)
    throw std::runtime_error(
        fmt::format("{}: cannot be opened; check that it exists and may be read", list.string()));
  std::vector<ImageFile> files;
  std::string line;
  for (int number = 1; std::getline(input, line); ++number) {
    if (line.empty() || line[0] == '#' || line == "\r") continue;
    std::istringstream words(line);
    long double seconds = 0.0L;
    std::string name;
    if (!(words >> seconds >> name) || !(seconds > 0.0L && seconds < 4e9L)) {
      throw std::runtime_error(
          fmt::format("{}, line {}: expected 'stamp file', found '{}'", list.string(), number, line));
    }
    files.push_back({static_cast<Nanoseconds>(std::llround(seconds * 1e9L)), list.parent_path() / name});
  }
  std::stable_sort(files.begin(), files.end(),
                   [](const auto& a, const auto& b) { return a.stamp < b.stamp; });
  return files;
}

/// One-to-one pairs (colour, depth), nearest first, in the order of the colour images.
std::vector<std::pair<std::size_t, std::size_t>> nearestPairs(const std::vector<ImageFile>& color,
                                                              const std::vector<ImageFile>& depth) {
  std::vector<std::tuple<Nanoseconds, std::size_t, std::size_t>> candidates;
  std::size_t first = 0;
  for (std::size_t c = 0; c < color.size(); ++c) {
    while (first < depth.size() && depth[first].stamp < color[c].stamp - kPairTolerance) ++first;
    for (std::size_t d = first; d < depth.size() && depth[d].stamp <= color[c].stamp + kPairTolerance; ++d) {
      candidates.emplace_back(std::abs(color[c].stamp - depth[d].stamp), c, d);
    }
  }
  std::sort(candidates.begin(), candidates.end());
  std::vector<bool> color_taken(color.size()), depth_taken(depth.size());
  std::vector<std::pair<std::size_t, std::size_t>> pairs;
  for (const auto& [difference, c, d] : candidates) {
    if (color_taken[c] || depth_taken[d]) continue;
    color_taken[c] = depth_taken[d] = true;
    pairs.emplace_back(c, d);
  }
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

}  // namespace

ImageFolder readTumFolder(const fs::path& directory) {
  const std::vector<ImageFile> color = readList(directory / "rgb.txt"),
                               depth = readList(directory / "depth.txt");
  ImageFolder folder;
  folder.camera = freiburg1();
  for (const auto& [c, d] : nearestPairs(color, depth)) {
    folder.color.push_back(color[c]);
    folder.depth.push_back({color[c].stamp, depth[d].path});
  }
  if (folder.color.empty()) {
    throw std::runtime_error(
        fmt::format("{}: no colour image of {} has a depth image of {} within 20 ms; the stamps of both "
                    "lists must be of one clock",
                    directory.string(), color.size(), depth.size()));
  }
  if (folder.color.size() < std::max(color.size(), depth.size())) {
    folder.warnings.push_back(fmt::format("{}: {} pairs within 20 ms from {} colour and {} depth images",
                                          directory.string(), folder.color.size(), color.size(),
                                          depth.size()));
  }
  return folder;
}

std::string tumCameraWarning(const fs::path& directory) {
  const FolderCamera camera = freiburg1();
  return fmt::format(
      "{}: there is no camera.yaml, so the TUM fr1 camera is assumed: fx {} fy {} cx {} cy {}, D [{}], depth "
      "1/{} m. "
      "For another camera give --camera FILE",
      directory.string(), camera.camera.fx, camera.camera.fy, camera.camera.cx, camera.camera.cy,
      fmt::join(camera.distortion, ", "), camera.depth_units_per_m);
}

}  // namespace softbody
