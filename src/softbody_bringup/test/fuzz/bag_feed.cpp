#include <rosbag/bag.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/Image.h>
#include <std_msgs/String.h>

#include "fuzz/byte_source.h"
#include "fuzz/feeds.h"
#include "fuzz/scratch_files.h"
#include "softbody_common/protocol/camera_topics.h"
#include "softbody_recordings/ros/bag_frames.h"
#include "softbody_recordings/ros/facts_reader.h"
#include "softbody_recordings/ros/input_bag.h"
#include "softbody_recordings/validation/checks.h"

namespace softbody::fuzz {
namespace {

constexpr int kMostMessages = 16;

std_msgs::Header header(ByteSource* source) {
  std_msgs::Header header;
  // Mostly a little later than the start, sometimes anything.
  const auto choice = source->value<std::uint8_t>();
  header.stamp.sec = choice < 250 ? 1000 + choice / 30 : source->value<std::uint32_t>();
  header.stamp.nsec = choice < 250 ? (choice % 30) * 33000000u : source->value<std::uint32_t>();
  header.frame_id = choice % 16 == 0 ? source->text(choice % 8) : "camera";
  return header;
}

sensor_msgs::Image image(ByteSource* source, bool is_depth) {
  static const char* const kEncodings[] = {"rgb8", "bgr8",        "16UC1",  "32FC1",   "mono8",
                                           "",     "bayer_rggb8", "yuv422", "8UC1000", "bgra16"};
  sensor_msgs::Image image;
  image.header = header(source);
  const auto choice = source->value<std::uint8_t>();
  image.encoding = choice < 200 ? (is_depth ? "16UC1" : "rgb8") : kEncodings[choice % 10];
  image.width = choice % 7 == 0 ? source->value<std::uint32_t>() : 8;
  image.height = choice % 11 == 0 ? source->value<std::uint32_t>() : 6;
  image.step = choice % 13 == 0 ? source->value<std::uint32_t>() : image.width * (is_depth ? 2 : 3);
  image.is_bigendian = choice % 5 == 0;
  image.data.assign(choice % 17 == 0 ? source->value<std::uint16_t>() : 6u * (is_depth ? 16 : 24),
                    source->value<std::uint8_t>());
  return image;
}

sensor_msgs::CameraInfo info(ByteSource* source) {
  sensor_msgs::CameraInfo info;
  info.header = header(source);
  const auto choice = source->value<std::uint8_t>();
  info.width = choice % 7 == 0 ? source->value<std::uint32_t>() : 8;
  info.height = choice % 11 == 0 ? source->value<std::uint32_t>() : 6;
  info.K = {10, 0, 4, 0, 10, 3, 0, 0, 1};
  if (choice % 3 == 0) info.K[choice % 9] = source->value<double>();
  info.distortion_model = choice % 5 == 0 ? source->text(choice % 12) : "plumb_bob";
  for (int k = 0; k < choice % 13; ++k) info.D.push_back(source->value<double>());
  return info;
}

void writeMessages(ByteSource* source, const std::string& path) {
  rosbag::Bag bag(path, rosbag::bagmode::Write);
  const CameraTopics topics("/camera");
  for (int k = 0; k < kMostMessages && !source->empty(); ++k) {
    const ros::Time received(1000, 1000000u * static_cast<unsigned>(k));
    switch (source->value<std::uint8_t>() % 6) {
      case 0:
        bag.write(topics.color, received, image(source, false));
        break;
      case 1:
        bag.write(topics.depth, received, image(source, true));
        break;
      case 2:
        bag.write(topics.color_info, received, info(source));
        break;
      case 3:
        bag.write(topics.depth_info, received, info(source));
        break;
      case 4:
        bag.write(topics.color, received, std_msgs::String());
        break;
      default:
        bag.write("/other", received, std_msgs::String());
    }
  }
}

}  // namespace

/// A bag of well-formed messages with any contents is validated and read as a replay reads it.
void giveBag(std::string_view bytes) {
  ByteSource source(bytes);
  const std::string path = (scratch() / "recording.bag").string();
  writeMessages(&source, path);
  const validation::RecordingFacts facts = validation::readFacts(path, BagFramesConfig(), [](double) {});
  validation::toText(facts, validation::check(facts));
  const rosbag::Bag bag = openBag(path);
  CameraIngest ingest{CameraIngestConfig()};
  try {
    readBagFrames(bag, BagFramesConfig(), &ingest, [](const auto&, const auto&, double) {});
  } catch (const std::invalid_argument&) {
  }
}

}  // namespace softbody::fuzz
