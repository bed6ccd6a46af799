#include "softbody_recordings/ros/atomic_bag.h"

#include <ros/console.h>

#include <stdexcept>

namespace softbody {

AtomicBag::AtomicBag(std::filesystem::path output, rosbag::CompressionType compression)
    : output_(std::move(output)), temporary_(output_.string() + ".part") {
  if (std::filesystem::is_directory(output_)) {
    throw std::invalid_argument(output_.string() + " is a folder, not a bag to write");
  }
  bag_.open(temporary_.string(), rosbag::bagmode::Write);
  bag_.setCompression(compression);
}

AtomicBag::~AtomicBag() {
  if (!bag_.isOpen()) return;
  // Closing writes the index, which a full disk refuses; the file goes away in any case.
  try {
    bag_.close();
  } catch (const std::exception& error) {
    ROS_DEBUG_STREAM(temporary_.string() << " was not closed: " << error.what());
  }
  std::error_code ignored;
  std::filesystem::remove(temporary_, ignored);
}

void AtomicBag::finish() {
  bag_.close();
  std::filesystem::rename(temporary_, output_);
}

}  // namespace softbody
