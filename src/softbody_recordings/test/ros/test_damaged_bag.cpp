#include <gtest/gtest.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/Image.h>
#include <tf2_msgs/TFMessage.h>
#include <unistd.h>

#include <cstdint>
#include <exception>
#include <fstream>
#include <functional>
#include <random>
#include <string>

#include "softbody_recordings/ros/bag_frames.h"
#include "softbody_recordings/ros/bag_transforms.h"
#include "softbody_recordings/ros/input_bag.h"

namespace softbody {
namespace {

template <typename Message>
void write(rosbag::Bag* bag, const std::string& topic, int k, Message message) {
  bag->write(topic, ros::Time(100.0 + k), message);
}

/// A compressed bag whose index is whole, but not its images and transforms.
std::string damagedBag() {
  const std::string path = testing::TempDir() + "damaged" + std::to_string(getpid()) + ".bag";
  const CameraTopics topics("/camera");
  std::mt19937 random(1);
  rosbag::Bag bag(path, rosbag::bagmode::Write);
  bag.setCompression(rosbag::compression::BZ2);
  for (int k = 0; k < 20; ++k) {
    sensor_msgs::Image image;
    for (int i = 0; i < 10'000; ++i) image.data.push_back(static_cast<std::uint8_t>(random()));
    write(&bag, topics.color, k, image);
    write(&bag, topics.depth, k, image);
    write(&bag, topics.color_info, k, sensor_msgs::CameraInfo());
    write(&bag, "/tf", k, tf2_msgs::TFMessage());
  }
  bag.close();
  std::fstream file(path, std::ios::binary | std::ios::in | std::ios::out);
  file.seekp(50'000);
  file << std::string(1000, 'x');
  return path;
}

/// Which file, and what to do.
void expectSentence(const std::string& path, const std::function<void()>& read) {
  try {
    read();
    ADD_FAILURE() << "the bag is read";
  } catch (const std::exception& error) {
    const std::string sentence = error.what();
    EXPECT_EQ(sentence.find(path), 0u) << sentence;
    EXPECT_NE(sentence.find("rosbag reindex"), std::string::npos) << sentence;
  }
}

TEST(DamagedBag, IsNamedWithARemedy) {
  const std::string path = damagedBag();
  expectSentence(path, [&] { BagTransforms({path}); });
  expectSentence(path, [&] {
    const rosbag::Bag bag = openBag(path);
    CameraIngest ingest{CameraIngestConfig()};
    readBagFrames(bag, {}, &ingest, [](const auto&, const auto&, double) {});
  });
}

}  // namespace
}  // namespace softbody
