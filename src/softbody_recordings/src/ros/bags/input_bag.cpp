#include "softbody_recordings/ros/input_bag.h"

#include <fmt/format.h>

#include <filesystem>
#include <fstream>

namespace softbody {
namespace {

constexpr char kRos2[] =
    "is a recording of ROS 2; convert it to a bag of ROS 1 (rosbags-convert --src FOLDER --dst NAME.bag)";
constexpr char kRecover[] = "recovers the readable part";

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

std::string whatIsFolder(const std::filesystem::path& path) {
  if (std::filesystem::exists(path / "metadata.yaml")) return kRos2;
  if (std::filesystem::exists(path / "color") || std::filesystem::exists(path / "rgb.txt"))
    return "is a folder of images; make a bag of it with import_images";
  for (const auto& entry : std::filesystem::directory_iterator(path))
    if (entry.path().extension() == ".bag")
      return fmt::format("is a folder; give one of its bags, for example {}", entry.path().string());
  return "is a folder; give a bag";
}

/// Why a file is no bag that can be read; empty: it looks like one.
std::string whatIsFile(const std::string& path) {
  const std::string bytes = beginningOf(path);
  if (bytes.empty()) return "is empty; nothing was recorded, or nothing was copied: record or copy it again";
  if (begins(bytes, "SQLite format 3") || begins(bytes, "\x89MCAP")) return kRos2;
  if (begins(bytes, "#ROSBAG V2.")) return "";
  if (begins(bytes, "#ROS"))
    return fmt::format(
        "is a bag of an old version ({}); convert it with rosbag fix {} NEW.bag, with a ROS of its time",
        bytes.substr(1, bytes.find('\n') - 1), path);
  return "is not a bag: it does not begin with #ROSBAG V2.0; record one with rosbag record";
}

}  // namespace

rosbag::Bag openBag(const std::string& path) try {
  if (!std::filesystem::exists(path)) throw std::invalid_argument(fmt::format("{}: no such file", path));
  if (std::filesystem::is_directory(path))
    throw std::invalid_argument(fmt::format("{} {}", path, whatIsFolder(path)));
  if (!std::filesystem::is_regular_file(path))
    throw std::invalid_argument(fmt::format("{} is not a file", path));
  if (const std::string fault = whatIsFile(path); !fault.empty())
    throw std::invalid_argument(fmt::format("{} {}", path, fault));
  return rosbag::Bag(path, rosbag::bagmode::Read);
} catch (const rosbag::BagUnindexedException&) {
  throw std::invalid_argument(
      fmt::format("{} was not closed, so it has no index; run rosbag reindex {}", path, path));
} catch (const rosbag::BagException& error) {
  throw std::invalid_argument(fmt::format("{} is truncated or damaged ({}); rosbag reindex {} {}", path,
                                          error.what(), path, kRecover));
}

std::runtime_error damagedBag(const std::string& path, const rosbag::BagException& error) {
  return std::runtime_error(
      fmt::format("{} is damaged ({}); rosbag reindex {} {}", path, error.what(), path, kRecover));
}

}  // namespace softbody
