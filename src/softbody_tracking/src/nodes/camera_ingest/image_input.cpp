#include "nodes/camera_ingest/image_input.h"

#include <image_transport/exception.h>

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "softbody_tracking/camera/frame_pairer.h"
#include "softbody_tracking/ros/compressed_image.h"

namespace softbody {
namespace {

constexpr double kChoicePeriod_s = 0.1;  // [s] a player of bags waits longer before its first message

/// The transport of a topic's images that somebody publishes, raw ones first; empty: nobody does.
std::string publishedTransport(const std::string& base_topic) {
  ros::master::V_TopicInfo topics;
  ros::master::getTopics(topics);
  const auto has = [&](const std::string& name) {
    return std::any_of(topics.begin(), topics.end(), [&](const auto& topic) { return topic.name == name; });
  };
  if (has(base_topic)) return "raw";
  for (const char* transport : {"compressed", "compressedDepth"})
    if (has(base_topic + "/" + transport)) return transport;
  return "";
}

}  // namespace

ImageInput::ImageInput(ros::NodeHandle handle, const std::string& topic, const std::string& transport,
                       Use use, Refuse refuse) try
    : handle_(handle),
      base_topic_(handle.resolveName(topic)),
      use_(std::move(use)),
      refuse_(std::move(refuse)) {
  if (transport != "auto") {
    subscribe(transport);
    return;
  }
  choice_ = handle.createWallTimer(ros::WallDuration(kChoicePeriod_s),
                                   [this](const ros::WallTimerEvent&) { choose(); });
} catch (const image_transport::Exception& error) {
  throw std::invalid_argument("transport '" + transport + "' of " + topic +
                              " is not installed; raw, compressed and compressedDepth always work");
}

void ImageInput::subscribe(const std::string& transport) {
  if (transport == "compressed" || transport == "compressedDepth") {
    compressed_ = handle_.subscribe<sensor_msgs::CompressedImage>(
        base_topic_ + "/" + transport, kMostWaiting, [this](const auto& image) { decode(*image); }, nullptr,
        ros::TransportHints().tcpNoDelay());
    return;
  }
  transport_.emplace(handle_);
  images_ = transport_->subscribe(
      base_topic_, kMostWaiting, [this](const sensor_msgs::ImageConstPtr& image) { use_(image); }, nullptr,
      image_transport::TransportHints(transport, ros::TransportHints().tcpNoDelay(), handle_,
                                      "no_parameter"));
}

/// A publisher announces its transports one after the other, so they count when they were the same twice.
void ImageInput::choose() {
  const std::string found = publishedTransport(base_topic_);
  const bool is_settled = !found.empty() && found == published_;
  published_ = found;
  if (!is_settled) return;
  choice_.stop();
  if (found != "raw") ROS_INFO_STREAM("reads " << base_topic_ << "/" << found << ": there are no raw images");
  subscribe(found);
}

std::string ImageInput::topic() const {
  if (compressed_) return compressed_.getTopic();
  return images_ ? images_.getTopic() : base_topic_;
}

int ImageInput::publishers() const {
  return static_cast<int>(compressed_ ? compressed_.getNumPublishers() : images_.getNumPublishers());
}

void ImageInput::decode(const sensor_msgs::CompressedImage& image) const {
  sensor_msgs::ImageConstPtr raw;
  try {
    raw = decompressed(image);
  } catch (const std::invalid_argument& error) {
    return refuse_(topic() + ": " + error.what());
  }
  use_(raw);
}

}  // namespace softbody
