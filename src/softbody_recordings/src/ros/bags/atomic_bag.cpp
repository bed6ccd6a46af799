#include "softbody_recordings/ros/atomic_bag.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <stdexcept>
#include <vector>

namespace softbody {
namespace {

/// Keeps a bag that cannot be closed, because its destructor would write again, throw and so end the program.
void keep(std::unique_ptr<rosbag::Bag> bag, const std::filesystem::path& path) {
  static auto& kept = *new std::vector<std::unique_ptr<rosbag::Bag>>();
  kept.push_back(std::move(bag));
  // The file stays open; it must not go on filling the disk.
  std::error_code ignored;
  std::filesystem::resize_file(path, 0, ignored);
}

/// Closes a bag that is not wanted. Closing writes the index, which a full disk refuses.
void discard(std::unique_ptr<rosbag::Bag> bag, const std::filesystem::path& path) {
  try {
    bag->close();
  } catch (const std::exception&) {
    keep(std::move(bag), path);
  }
}

}  // namespace

AtomicBag::AtomicBag(const std::filesystem::path& output, rosbag::CompressionType compression)
    : file_(output) {
  try {
    errno = 0;
    bag_->open(file_.path().string(), rosbag::bagmode::Write);
    bag_->setCompression(compression);
  } catch (const rosbag::BagException& error) {
    const int reason = errno;
    discard(std::move(bag_), file_.path());
    fail(error, reason);
  }
}

AtomicBag::~AtomicBag() {
  if (bag_) discard(std::move(bag_), file_.path());
}

void AtomicBag::finish() {
  try {
    errno = 0;
    bag_->close();
  } catch (const rosbag::BagException& error) {
    const int reason = errno;
    keep(std::move(bag_), file_.path());
    fail(error, reason);
  }
  bag_.reset();
  file_.commit();
}

void AtomicBag::fail(const rosbag::BagException& error, int reason) const {
  const std::string file = file_.target().string();
  if (reason == 0) throw std::runtime_error(fmt::format("{}: {}", file, error.what()));
  throw std::runtime_error(fmt::format("{}: cannot be written: {}", file, std::strerror(reason)));
}

}  // namespace softbody
