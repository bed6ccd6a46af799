#include <gtest/gtest.h>
#include <nodelet/loader.h>
#include <ros/ros.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/Image.h>
#include <softbody_msgs/MeshTopology.h>
#include <softbody_msgs/TetTopology.h>

#include <boost/make_shared.hpp>
#include <cmath>
#include <cstring>
#include <string>
#include <vector>

/// Nodelets hand messages on without copies. This process is their manager, so that it sees the same memory.
namespace softbody {
namespace {

constexpr int kWidth = 64, kHeight = 48;

sensor_msgs::ImagePtr image(const std::string& encoding, int bytes) {
  const auto message = boost::make_shared<sensor_msgs::Image>();
  message->header.frame_id = "camera_color_optical_frame";
  message->width = kWidth;
  message->height = kHeight;
  message->encoding = encoding;
  message->step = static_cast<std::uint32_t>(kWidth * bytes);
  message->data.resize(message->step * kHeight, 3);  // depth: 771 mm
  return message;
}

/// @param distortion k1. 0: images need not be rectified.
sensor_msgs::CameraInfo cameraInfo(double distortion) {
  sensor_msgs::CameraInfo info;
  info.header.frame_id = "camera_color_optical_frame";
  info.width = kWidth;
  info.height = kHeight;
  info.distortion_model = "plumb_bob";
  info.D = {distortion, 0, 0, 0, 0};
  info.K = {60, 0, 32, 0, 60, 24, 0, 0, 1};
  info.R = {1, 0, 0, 0, 1, 0, 0, 0, 1};
  info.P = {60, 0, 32, 0, 0, 60, 24, 0, 0, 0, 1, 0};
  return info;
}

template <typename Message>
class Received {
 public:
  explicit Received(const std::string& topic)
      : subscriber_(ros::NodeHandle().subscribe<Message>(
            topic, 20, [this](const auto& message) { messages.push_back(message); })) {}

  bool connected() const { return subscriber_.getNumPublishers() > 0; }
  std::vector<boost::shared_ptr<const Message>> messages;

 private:
  ros::Subscriber subscriber_;
};

template <typename Condition>
bool becomesTrue(const Condition& condition) {
  const ros::WallTime end = ros::WallTime::now() + ros::WallDuration(60.0);
  while (!condition() && ros::WallTime::now() < end) {
    ros::spinOnce();
    ros::WallDuration(0.005).sleep();
  }
  return condition();
}

class SameMemory : public testing::Test {
 protected:
  void load(const std::string& name, const std::string& type) {
    ASSERT_TRUE(manager_.load("/softbody/" + name, type, ros::names::getRemappings(), {}));
  }

  nodelet::Loader manager_{false};
};

class Camera : public SameMemory {
 protected:
  void SetUp() override {
    load("camera_ingest", "softbody_tracking/CameraIngest");
    ASSERT_TRUE(becomesTrue([this] {
      return color_in_.getNumSubscribers() > 0 && depth_in_.getNumSubscribers() > 0 &&
             info_in_.getNumSubscribers() > 0 && color_.connected() && depth_.connected();
    }));
  }

  /// Sends a frame; what comes of it is the last one in color_ and depth_.
  void send(const sensor_msgs::ImagePtr& color, double distortion) {
    stamp_ += ros::Duration(0.1);
    const sensor_msgs::ImagePtr depth = image("16UC1", 2);
    sensor_msgs::CameraInfo info = cameraInfo(distortion);
    color->header.stamp = depth->header.stamp = info.header.stamp = stamp_;
    const std::size_t before = depth_.messages.size();
    info_in_.publish(info);
    // The camera_info of another camera must not come after the images.
    ros::WallDuration(0.2).sleep();
    color_in_.publish(sensor_msgs::ImageConstPtr(color));
    depth_in_.publish(sensor_msgs::ImageConstPtr(depth));
    ASSERT_TRUE(
        becomesTrue([&] { return depth_.messages.size() > before && color_.messages.size() > before; }));
    EXPECT_EQ(color_.messages.back()->header.stamp, stamp_);
  }

  ros::NodeHandle node_;
  ros::Time stamp_ = ros::Time::now();
  ros::Publisher color_in_ = node_.advertise<sensor_msgs::Image>("/camera/color/image_raw", 5);
  ros::Publisher depth_in_ =
      node_.advertise<sensor_msgs::Image>("/camera/aligned_depth_to_color/image_raw", 5);
  ros::Publisher info_in_ = node_.advertise<sensor_msgs::CameraInfo>("/camera/color/camera_info", 5);
  Received<sensor_msgs::Image> color_{"/softbody/rgb/image_rect_color"}, depth_{"/softbody/depth/image_rect"};
};

TEST_F(Camera, RectifiedColourIsTheDriversOwnMessage) {
  for (const char* encoding : {"bgr8", "rgb8"}) {
    const sensor_msgs::ImagePtr color = image(encoding, 3);
    send(color, 0.0);
    EXPECT_EQ(color_.messages.back()->data.data(), color->data.data()) << encoding;
    EXPECT_EQ(color_.messages.back()->encoding, encoding);
  }
  const auto z = *reinterpret_cast<const float*>(depth_.messages.back()->data.data() + 400);
  EXPECT_FLOAT_EQ(z, 0.771f);
}

TEST_F(Camera, WhatMustBeChangedIsAnotherMessage) {
  const sensor_msgs::ImagePtr distorted = image("bgr8", 3);
  send(distorted, -0.2);
  EXPECT_NE(color_.messages.back()->data.data(), distorted->data.data());
  const sensor_msgs::ImagePtr four = image("bgra8", 4);
  send(four, 0.0);
  EXPECT_EQ(color_.messages.back()->encoding, "bgr8");
  const sensor_msgs::ImagePtr slash = image("bgr8", 3);
  slash->header.frame_id = "/" + slash->header.frame_id;
  send(slash, 0.0);
  EXPECT_EQ(color_.messages.back()->header.frame_id, "camera_color_optical_frame");
}

/// It is sent again every second, so that recordings have it.
TEST_F(SameMemory, ATopologyIsSentAgainAsTheSameMessage) {
  const Received<softbody_msgs::TetTopology> volume("/softbody/volume/topology");
  const Received<softbody_msgs::MeshTopology> surface("/softbody/surface/topology");
  load("simulator", "softbody_sim/Simulator");
  load("surface", "softbody_sim/Surface");
  ASSERT_TRUE(becomesTrue([&] { return volume.messages.size() > 2 && surface.messages.size() > 2; }));
  for (const auto& message : volume.messages) EXPECT_EQ(message, volume.messages.front());
  for (const auto& message : surface.messages) EXPECT_EQ(message, surface.messages.front());
}

}  // namespace
}  // namespace softbody

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "test_same_memory");
  return RUN_ALL_TESTS();
}
