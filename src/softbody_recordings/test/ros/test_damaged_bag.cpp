#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/Image.h>
#include <test_support/gtest.h>
#include <tf2_msgs/TFMessage.h>
#include <unistd.h>

#include <cstdint>
#include <exception>
#include <filesystem>
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
  const std::string sentence = complaint<std::exception>([&] { read(); });
  EXPECT_EQ(sentence.find(path), 0u) << sentence;
  EXPECT_TRUE(says(sentence, "rosbag reindex " + path));
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

/// What openBag() says.
std::string refusal(const std::string& path) {
  try {
    openBag(path);
  } catch (const std::invalid_argument& error) {
    EXPECT_EQ(std::string(error.what()).find(path), 0u) << error.what();
    return error.what();
  }
  return "";
}

TEST(InputBag, WhatIsNoBagIsNamedForWhatItIs) {
  const std::filesystem::path folder =
      std::filesystem::path(testing::TempDir()) / ("kinds" + std::to_string(getpid()));
  std::filesystem::create_directories(folder / "ros2");
  std::filesystem::create_directories(folder / "bags");
  std::filesystem::create_directories(folder / "images/color");
  const auto write = [&folder](const std::string& name, const std::string& bytes) {
    std::ofstream(folder / name, std::ios::binary) << bytes;
  };
  write("ros2/metadata.yaml", "rosbag2_bagfile_information:");
  write("bags/a.bag", "");
  write("empty.bag", "");
  write("text.bag", "time,x,y");
  write("ros2.db3", "SQLite format 3" + std::string(1, '\0') + "....");
  write("ros2.mcap", "\x89MCAP0\r\n....");
  write("old.bag", "#ROSBAG V1.2\n....");
  write("begin.bag", "#ROSBAG V2.0\n");
  const std::pair<const char*, const char*> sentences[] = {
      {"empty.bag", "is empty"},
      {"text.bag", "is not a bag"},
      {"ros2.db3", "is a recording of ROS 2; convert it"},
      {"ros2.mcap", "is a recording of ROS 2; convert it"},
      {"ros2", "is a recording of ROS 2; convert it"},
      {"old.bag", "is a bag of an old version (ROSBAG V1.2)"},
      {"begin.bag", "rosbag reindex"},
      {"bags", "a.bag"},
      {"images", "import_images"},
      {"missing.bag", "no such file"}};
  for (const auto& [name, words] : sentences) {
    const std::string sentence = refusal((folder / name).string());
    EXPECT_TRUE(says(sentence, words));
  }
  std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace softbody
