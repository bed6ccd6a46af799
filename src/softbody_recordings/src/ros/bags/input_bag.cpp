#include "softbody_recordings/ros/input_bag.h"

#include <fmt/format.h>

#include <filesystem>

namespace softbody {

rosbag::Bag openBag(const std::string& path) try {
  if (!std::filesystem::exists(path)) throw std::invalid_argument(fmt::format("{}: no such file", path));
  if (!std::filesystem::is_regular_file(path))
    throw std::invalid_argument(fmt::format("{} is not a file", path));
  return rosbag::Bag(path, rosbag::bagmode::Read);
} catch (const rosbag::BagUnindexedException&) {
  throw std::invalid_argument(fmt::format("{}: the bag was not closed; run rosbag reindex {}", path, path));
} catch (const rosbag::BagException& error) {
  throw std::invalid_argument(fmt::format(
      "{} is not a complete bag ({}); rosbag reindex recovers the readable part", path, error.what()));
}

std::runtime_error damagedBag(const std::string& path, const rosbag::BagException& error) {
  return std::runtime_error(
      fmt::format("{} is damaged ({}); rosbag reindex recovers the readable part", path, error.what()));
}

}  // namespace softbody
