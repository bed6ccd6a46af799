// A recording with jitter, drops, offsets, late and repeated images gives the same frames live and in a
// replay.
#include <gtest/gtest.h>
#include <message_filters/subscriber.h>
#include <message_filters/time_synchronizer.h>
#include <ros/ros.h>
#include <rosbag/bag.h>
#include <rosbag/view.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/Image.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <map>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "softbody_recordings/ros/bag_frames.h"

namespace softbody {
namespace {

constexpr int kWidth = 32, kHeight = 24, kNoDepth = 0, kFramesPerOffset = 80;
constexpr double kPeriod_s = 1.0 / 30.0;
const std::string kColor = "/camera/color/image_raw", kInfo = "/camera/color/camera_info",
                  kDepth = "/camera/aligned_depth_to_color/image_raw";

/// Stamp of the colour image [ns], and the number of the depth image [mm] of each frame.
using Frames = std::vector<std::pair<Nanoseconds, int>>;

sensor_msgs::Image image(double stamp_s, const std::string& encoding, std::vector<std::uint8_t> pixel) {
  sensor_msgs::Image message;
  message.header.stamp = ros::Time(stamp_s);
  message.header.frame_id = "camera_color_optical_frame";
  message.width = kWidth;
  message.height = kHeight;
  message.encoding = encoding;
  message.step = static_cast<std::uint32_t>(kWidth * pixel.size());
  for (int i = 0; i < kWidth * kHeight; ++i)
    message.data.insert(message.data.end(), pixel.begin(), pixel.end());
  return message;
}

sensor_msgs::Image colorImage(double stamp_s) { return image(stamp_s, "rgb8", {90, 60, 30}); }

/// Every pixel is the image's number in mm, by which it is known again.
sensor_msgs::Image depthImage(double stamp_s, int number) {
  return image(stamp_s, "16UC1",
               {static_cast<std::uint8_t>(number & 255), static_cast<std::uint8_t>(number >> 8)});
}

/// 0 if nothing was measured.
int numberOf(float metres) {
  return metres > 0.0F ? static_cast<int>(std::lround(1000.0F * metres)) : kNoDepth;
}

sensor_msgs::CameraInfo cameraInfo(double stamp_s) {
  sensor_msgs::CameraInfo info;
  info.header.stamp = ros::Time(stamp_s);
  info.width = kWidth;
  info.height = kHeight;
  info.K = {30, 0, 16, 0, 30, 12, 0, 0, 1};
  info.R = {1, 0, 0, 0, 1, 0, 0, 0, 1};
  info.P = {30, 0, 16, 0, 0, 30, 12, 0, 0, 0, 1, 0};
  return info;
}

/// A camera whose depth has an offset to colour that changes on the way; images are lost, repeated and late.
class FaultyCamera {
 public:
  explicit FaultyCamera(const std::string& path) : bag_(path, rosbag::bagmode::Write) {
    for (const double offset_s : {0.0, 0.01, -0.01, 0.015, -0.015}) record(offset_s);
    // The end settles all frames before it.
    for (int i = 0; i < 3; ++i) record(0.0, 0.0, false);
  }

 private:
  void record(double offset_s) {
    const double jitter_s = std::abs(offset_s) > 0.012 ? 0.0 : 0.004;
    for (int i = 0; i < kFramesPerOffset; ++i) record(offset_s, jitter_s, true);
  }

  void record(double offset_s, double jitter_s, bool faulty) {
    std::uniform_real_distribution<double> jitter(-jitter_s, jitter_s), share(0.0, 1.0);
    const double color_s = now_s_, depth_s = now_s_ + offset_s + (jitter_s > 0.0 ? jitter(random_) : 0.0);
    write(kInfo, color_s, cameraInfo(color_s));
    const double color_fate = faulty ? share(random_) : 1.0, depth_fate = faulty ? share(random_) : 1.0;
    if (color_fate > 0.1) write(kColor, color_s, colorImage(color_s));
    if (color_fate > 0.9 && faulty) write(kColor, color_s + 0.001, colorImage(color_s));
    const double late_s = depth_fate > 0.9 && faulty ? 0.05 : 0.0;
    if (depth_fate > 0.1) write(kDepth, depth_s + late_s, depthImage(depth_s, ++number_));
    now_s_ += kPeriod_s;
  }

  template <typename Message>
  void write(const std::string& topic, double time_s, const Message& message) {
    bag_.write(topic, ros::Time(time_s), message);
  }

  rosbag::Bag bag_;
  std::mt19937 random_{7};
  double now_s_ = 100.0;
  int number_ = 300;  // in mm, beyond the least depth
};

Frames replayed(const std::string& path) {
  Frames frames;
  CameraIngest ingest{CameraIngestConfig()};
  readBagFrames(rosbag::Bag(path), BagFramesConfig(), &ingest,
                [&frames](const RgbdFrame& frame, const std_msgs::Header&, double) {
                  frames.emplace_back(frame.stamp, numberOf(frame.depth(kHeight / 2, kWidth / 2)));
                });
  return frames;
}

/// Publishes a recording for the node under test, and collects the frames it makes.
class LiveGraph {
 public:
  LiveGraph()
      : color_in_(node_, "/softbody/rgb/image_rect_color", 1000),
        depth_in_(node_, "/softbody/depth/image_rect", 1000),
        pairs_(color_in_, depth_in_, 1000) {
    pairs_.registerCallback(&LiveGraph::onFrame, this);
    for (const std::string& topic : {kColor, kDepth})
      publishers_[topic] = node_.advertise<sensor_msgs::Image>(topic, 1000);
    publishers_[kInfo] = node_.advertise<sensor_msgs::CameraInfo>(kInfo, 1000);
  }

  Frames play(const std::string& path, std::size_t expected) {
    waitFor([this] {
      for (const auto& [topic, publisher] : publishers_)
        if (publisher.getNumSubscribers() == 0) return false;
      return color_in_.getSubscriber().getNumPublishers() > 0 &&
             depth_in_.getSubscriber().getNumPublishers() > 0;
    });
    rosbag::Bag bag(path);
    for (const rosbag::MessageInstance& message : rosbag::View(bag)) {
      if (message.getTopic() == kInfo)
        publishers_[kInfo].publish(message.instantiate<sensor_msgs::CameraInfo>());
      else
        publishers_[message.getTopic()].publish(message.instantiate<sensor_msgs::Image>());
      ros::WallDuration(0.004).sleep();
      ros::spinOnce();
    }
    waitFor([&] { return frames_.size() >= expected; });
    return frames_;
  }

 private:
  void onFrame(const sensor_msgs::ImageConstPtr& color, const sensor_msgs::ImageConstPtr& depth) {
    const float centre =
        reinterpret_cast<const float*>(depth->data.data())[kHeight / 2 * kWidth + kWidth / 2];
    frames_.emplace_back(static_cast<Nanoseconds>(color->header.stamp.toNSec()), numberOf(centre));
  }

  template <typename Condition>
  static void waitFor(const Condition& condition) {
    const ros::WallTime end = ros::WallTime::now() + ros::WallDuration(30.0);
    while (!condition() && ros::WallTime::now() < end) {
      ros::spinOnce();
      ros::WallDuration(0.01).sleep();
    }
  }

  ros::NodeHandle node_;
  Frames frames_;
  std::map<std::string, ros::Publisher> publishers_;
  message_filters::Subscriber<sensor_msgs::Image> color_in_, depth_in_;
  message_filters::TimeSynchronizer<sensor_msgs::Image, sensor_msgs::Image> pairs_;
};

TEST(Pairing, LiveGraphAndReplayMakeTheSameFrames) {
  const std::string path =
      std::filesystem::temp_directory_path() / ("softbody_pairing_" + std::to_string(getpid()) + ".bag");
  { const FaultyCamera camera(path); }
  const Frames expected = replayed(path);
  int with_depth = 0;
  for (const auto& [stamp, number] : expected) with_depth += number != kNoDepth ? 1 : 0;
  // The faults leave most colour images their depth, and take it from some.
  EXPECT_GT(with_depth, 3 * kFramesPerOffset);
  EXPECT_GT(static_cast<int>(expected.size()) - with_depth, 10);
  const Frames live = LiveGraph().play(path, expected.size());
  std::filesystem::remove(path);
  ASSERT_EQ(live.size(), expected.size());
  for (std::size_t i = 0; i < live.size(); ++i) {
    EXPECT_EQ(live[i].first, expected[i].first) << "colour image of frame " << i;
    EXPECT_EQ(live[i].second, expected[i].second) << "depth image of frame " << i;
  }
}

}  // namespace
}  // namespace softbody

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "test_pairing");
  return RUN_ALL_TESTS();
}
