#include "nodes/camera_ingest/camera_ingest_node.h"

#include "softbody_common/ros/conversions.h"
#include "softbody_common/ros/ros_parameters.h"
#include "softbody_common/topics.h"
#include "softbody_tracking/ros/conversions.h"

namespace softbody {

CameraIngestNode::CameraIngestNode(ros::NodeHandle handle, const ros::NodeHandle& private_handle) {
  Parameters parameters = readParameters(private_handle);
  const PairingConfig pairing = readPairingConfig(parameters);
  const double voxel_size_m = parameters.number("voxel_size_m", 0.0, 0.0, 1.0);
  const double silence_timeout_s = parameters.number("silence_timeout_s", 2.0, 0.1, 3600.0);
  ingest_.emplace(readCameraIngestConfig(parameters));
  // Read by image_transport itself.
  parameters.text("image_transport", "raw");
  warnUnknown(parameters);
  pairer_.emplace(pairing);
  outputs_.emplace(handle, voxel_size_m, static_cast<std::uint32_t>(pairing.queue_size));
  watch_.emplace(handle, private_handle, pairing, silence_timeout_s, [this] { return streamTopics(); });
  subscribe(handle, private_handle, pairing.queue_size);
}

CameraIngestNode::~CameraIngestNode() {
  // No callback may run while its members are destroyed: first the images stop, then the watch that asks for
  // their topics.
  color_subscriber_.shutdown();
  depth_subscriber_.shutdown();
  info_subscriber_.shutdown();
  watch_.reset();
}

void CameraIngestNode::subscribe(ros::NodeHandle handle, const ros::NodeHandle& private_handle,
                                 int queue_size) {
  const auto queue = static_cast<std::uint32_t>(queue_size);
  const image_transport::TransportHints hints("raw", ros::TransportHints().tcpNoDelay(), private_handle);
  transport_.emplace(handle);
  info_subscriber_ = handle.subscribe(topics::kCameraColorInfo, queue, &CameraIngestNode::onInfo, this);
  color_subscriber_ =
      transport_->subscribe(topics::kCameraColor, queue, &CameraIngestNode::onColor, this, hints);
  depth_subscriber_ =
      transport_->subscribe(topics::kCameraDepth, queue, &CameraIngestNode::onDepth, this, hints);
}

StreamTopics CameraIngestNode::streamTopics() const {
  const auto topic = [](const auto& subscriber) {
    return StreamTopic{subscriber.getTopic(), static_cast<int>(subscriber.getNumPublishers())};
  };
  return {topic(color_subscriber_), topic(info_subscriber_), topic(depth_subscriber_)};
}

void CameraIngestNode::onColor(const sensor_msgs::ImageConstPtr& image) {
  const ros::Time& stamp = image->header.stamp;
  watch_->noteImage(Stream::kColor, stamp, pairer_->addColor(toNanoseconds(stamp), image));
  processCompleteFrames();
}

void CameraIngestNode::onDepth(const sensor_msgs::ImageConstPtr& image) {
  const ros::Time& stamp = image->header.stamp;
  watch_->noteImage(Stream::kDepth, stamp, pairer_->addDepth(toNanoseconds(stamp), image));
  processCompleteFrames();
}

void CameraIngestNode::onInfo(const sensor_msgs::CameraInfoConstPtr& info) {
  watch_->noteInfo(info->header.stamp);
  pairer_->setInfo(info);
  processCompleteFrames();
}

void CameraIngestNode::processCompleteFrames() {
  while (const std::optional<Pairer::Frame> frame = pairer_->next()) process(*frame);
}

void CameraIngestNode::process(const Pairer::Frame& images) {
  const auto note = [&] {
    watch_->noteFrame(images.color->header, images.depth ? &images.depth->header : nullptr);
  };
  if (!outputs_->hasSubscriber()) return note();
  try {
    RgbdFrame frame;
    {
      const auto stage = timer_.stage("camera ingest");
      frame = frameFromMessages(*images.color, images.depth.get(), *images.info, &*ingest_);
    }
    std_msgs::Header header = images.color->header;
    header.frame_id = withoutSlash(header.frame_id);
    outputs_->publish(frame, header, &timer_);
    note();
  } catch (const std::exception& error) {
    timer_.take();
    watch_->noteRefusal(error.what());
  }
}

}  // namespace softbody
