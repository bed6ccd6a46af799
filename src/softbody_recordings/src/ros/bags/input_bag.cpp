#include "softbody_recordings/ros/input_bag.h"

#include <fmt/format.h>

#include <filesystem>
#include <fstream>

namespace softbody {
namespace {

[[noreturn]] void refuse(const std::string& path, const std::string& why) {
  throw std::invalid_argument(path + " " + why);
}

[[noreturn]] void refuseRos2(const std::string& path) {
  refuse(
      path,
      "is a recording of ROS 2; convert it to a bag of ROS 1 (rosbags-convert --src FOLDER --dst NAME.bag)");
}

std::string beginningOf(const std::string& path) {
  std::string bytes(16, '\0');
  std::ifstream file(path, std::ios::binary);
  file.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  bytes.resize(static_cast<std::size_t>(file.gcount()));
  return bytes;
}

bool begins(const std::string& bytes, const std::string& with) {
  return bytes.compare(0, with.size(), with) == 0;
}

[[noreturn]] void refuseFolder(const std::filesystem::path& path) {
  const std::string name = path.string();
  if (std::filesystem::exists(path / "metadata.yaml")) refuseRos2(name);
  if (std::filesystem::exists(path / "color") || std::filesystem::exists(path / "rgb.txt"))
    refuse(name, "is a folder of images; make a bag of it with import_images");
  for (const auto& entry : std::filesystem::directory_iterator(path))
    if (entry.path().extension() == ".bag")
      refuse(name, fmt::format("is a folder; give one of its bags, for example {}", entry.path().string()));
  refuse(name, "is a folder; give a bag");
}

/// @throw std::invalid_argument unless the file begins as a bag that can be read.
void checkFile(const std::string& path) {
  const std::string bytes = beginningOf(path);
  if (begins(bytes, "#ROSBAG V2.")) return;
  if (bytes.empty())
    refuse(path, "is empty: nothing was recorded, or nothing was copied; record or copy it again");
  if (begins(bytes, "SQLite format 3") || begins(bytes, "\x89MCAP")) refuseRos2(path);
  if (begins(bytes, "#ROS"))
    refuse(path, fmt::format(
                     "is a bag of an old version ({}); convert it with rosbag fix {} NEW.bag, with a ROS of "
                     "its time",
                     bytes.substr(1, bytes.find('\n') - 1), path));
  refuse(path, "is not a bag: it does not begin with #ROSBAG V2.0; record one with rosbag record");
}

}  // namespace

rosbag::Bag openBag(const std::string& path) try {
  if (!std::filesystem::exists(path)) throw std::invalid_argument(fmt::format("{}: no such file", path));
  if (std::filesystem::is_directory(path)) refuseFolder(path);
  if (!std::filesystem::is_regular_file(path))
    throw std::invalid_argument(fmt::format("{} is not a file", path));
  checkFile(path);
  return rosbag::Bag(path, rosbag::bagmode::Read);
} catch (const rosbag::BagUnindexedException&) {
  refuse(path, fmt::format("was not closed, so it has no index; run rosbag reindex {}", path));
} catch (const rosbag::BagException& error) {
  refuse(path, fmt::format("is truncated or damaged ({}); rosbag reindex {} recovers the readable part",
                           error.what(), path));
}

std::runtime_error damagedBag(const std::string& path, const rosbag::BagException& error) {
  return std::runtime_error(fmt::format("{} is damaged ({}); rosbag reindex {} recovers the readable part",
                                        path, error.what(), path));
}

}  // namespace softbody
