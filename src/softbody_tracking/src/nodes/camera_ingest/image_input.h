#pragma once

#include <image_transport/image_transport.h>
#include <ros/ros.h>
#include <sensor_msgs/CompressedImage.h>
#include <sensor_msgs/Image.h>

#include <functional>
#include <optional>
#include <string>

namespace softbody {

/// Receives the images of a topic. The transports `compressed` and `compressedDepth` are decoded here,
/// because Debian has no plugins for them; image_transport does the others. `auto` takes the raw images if
/// they are published, or else the compressed ones, as soon as somebody publishes them.
class ImageInput {
 public:
  using Use = std::function<void(const sensor_msgs::ImageConstPtr&)>;
  using Refuse = std::function<void(const std::string& why)>;

  /// @throw std::invalid_argument if the transport is not installed.
  ImageInput(ros::NodeHandle handle, const std::string& topic, const std::string& transport, Use use,
             Refuse refuse);

  /// The topic without the name of its transport.
  const std::string& baseTopic() const { return base_topic_; }
  std::string topic() const;
  int publishers() const;

 private:
  void subscribe(const std::string& transport);
  void choose();
  void decode(const sensor_msgs::CompressedImage& image) const;

  ros::NodeHandle handle_;
  std::string base_topic_;
  Use use_;
  Refuse refuse_;
  std::optional<image_transport::ImageTransport> transport_;
  std::string published_;  ///< transport that choose() found last; empty: none
  // Last, so that callbacks end before the members that they use.
  image_transport::Subscriber images_;
  ros::Subscriber compressed_;
  ros::WallTimer choice_;
};

}  // namespace softbody
