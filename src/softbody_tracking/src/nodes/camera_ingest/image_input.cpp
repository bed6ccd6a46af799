#include "nodes/camera_ingest/image_input.h"

#include <image_transport/exception.h>

#include <stdexcept>
#include <utility>

#include "softbody_tracking/ros/compressed_image.h"

namespace softbody {

ImageInput::ImageInput(ros::NodeHandle handle, const std::string& topic, const std::string& transport,
                       std::uint32_t queue_size, Use use, Refuse refuse) try
    : base_topic_(handle.resolveName(topic)), use_(std::move(use)), refuse_(std::move(refuse)) {
  if (transport == "compressed" || transport == "compressedDepth") {
    compressed_ = handle.subscribe<sensor_msgs::CompressedImage>(
        base_topic_ + "/" + transport, queue_size, [this](const auto& image) { decode(*image); }, nullptr,
        ros::TransportHints().tcpNoDelay());
    return;
  }
  transport_.emplace(handle);
  images_ = transport_->subscribe(
      topic, queue_size, [this](const sensor_msgs::ImageConstPtr& image) { use_(image); }, nullptr,
      image_transport::TransportHints(transport, ros::TransportHints().tcpNoDelay(), handle, "no_parameter"));
} catch (const image_transport::Exception& error) {
  throw std::invalid_argument("transport '" + transport + "' of " + topic +
                              " is not installed; raw, compressed and compressedDepth always work");
}

std::string ImageInput::topic() const { return compressed_ ? compressed_.getTopic() : images_.getTopic(); }

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
