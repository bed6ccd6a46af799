#include "nodes/camera_ingest/camera_ingest_node.h"

#include "softbody_common/protocol/topics.h"
#include "softbody_common/ros/conversions.h"
#include "softbody_common/ros/frame_name.h"
#include "softbody_common/ros/ros_parameters.h"
#include "softbody_tracking/ros/conversions.h"

namespace softbody {

CameraIngestNode::CameraIngestNode(const ros::NodeHandle& handle, const ros::NodeHandle& private_handle)
    : options_(readOptions(private_handle, cameraIngestNodeParameters())) {
  ingest_.emplace(options_.ingest);
  pairer_.emplace(options_.pairing);
  outputs_.emplace(handle, options_.voxel_size_m);
  watch_.emplace(handle, private_handle, options_.pairing.tolerance, options_.silence_timeout_s,
                 [this] { return streamTopics(); });
  const auto lookup = [this](const auto& target, const auto& source, const auto&) {
    return newestTransform(target, source);
  };
  reader_.emplace(CameraReader::Config{handle.resolveName(topics::kCameraColor),
                                       handle.resolveName(topics::kCameraDepth), options_.depth_scale},
                  lookup, [](const std::string& sentence) { ROS_WARN_STREAM(sentence); });
  subscribe(handle);
  live_parameters_.emplace(private_handle, cameraIngestNodeParameters(), &options_,
                           [this](const CameraIngestOptions& next) {
                             ingest_.emplace(next.ingest);
                             outputs_->setVoxelSize(next.voxel_size_m);
                           });
}

CameraIngestNode::~CameraIngestNode() {
  // No callback may run while its members are destroyed: first the images stop, then the watch that asks for
  // their topics.
  color_.reset();
  depth_.reset();
  color_info_.shutdown();
  depth_info_subscriber_.shutdown();
  watch_.reset();
}

void CameraIngestNode::subscribe(ros::NodeHandle handle) {
  const auto refuse = [this](const std::string& why) { watch_->noteRefusal(why); };
  const ros::TransportHints hints = ros::TransportHints().tcpNoDelay();
  color_info_ =
      handle.subscribe(topics::kCameraColorInfo, kMostWaiting, &CameraIngestNode::onInfo, this, hints);
  depth_info_subscriber_ = handle.subscribe<sensor_msgs::CameraInfo>(
      topics::kCameraDepthInfo, kMostWaiting, [this](const auto& info) { depth_info_ = info; }, {}, hints);
  color_.emplace(
      handle, topics::kCameraColor, options_.color_transport, [this](const auto& image) { onColor(image); },
      refuse);
  depth_.emplace(
      handle, topics::kCameraDepth, options_.depth_transport, [this](const auto& image) { onDepth(image); },
      refuse);
}

StreamTopics CameraIngestNode::streamTopics() const {
  const auto images = [](const std::optional<ImageInput>& input) {
    if (!input) return StreamTopic();
    return StreamTopic{input->topic(), input->publishers(), input->baseTopic()};
  };
  const std::string info = color_info_.getTopic();
  return {images(color_), StreamTopic{info, static_cast<int>(color_info_.getNumPublishers()), info},
          images(depth_)};
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

/// The newest transform: the two cameras are fixed to each other.
Eigen::Isometry3d CameraIngestNode::newestTransform(const std::string& target, const std::string& source) {
  if (!transforms_) transforms_.emplace();
  return fromMessage(transforms_->buffer().lookupTransform(target, source, ros::Time(0)).transform);
}

void CameraIngestNode::process(const Pairer::Frame& images) {
  if (!outputs_->hasSubscriber()) return watch_->noteFrame(images.color->header);
  try {
    std_msgs::Header header = images.color->header;
    header.frame_id = frameName(header.frame_id, color_->topic());
    IngestedFrame frame;
    {
      const auto stage = timer_.stage("camera ingest");
      frame = ingest(images, header);
    }
    outputs_->publish(frame, header, &timer_);
    watch_->noteFrame(images.color->header);
  } catch (const std::exception& error) {
    timer_.take();
    watch_->noteRefusal(error.what());
  }
}

/// The driver's colour is handed on as it is, if it is rectified and every reader understands it.
IngestedFrame CameraIngestNode::ingest(const Pairer::Frame& images, const std_msgs::Header& header) {
  CameraImages raw =
      reader_->readWithoutColor({*images.color, images.depth.get(), *images.info, depth_info_.get()});
  IngestedFrame result;
  if (isAlreadyRectified(raw.distortion, raw.rectified) && isUsualColor(*images.color) &&
      images.color->header.frame_id == header.frame_id)
    result.color_message = images.color;
  RgbdFrame& frame = result.frame;
  frame.stamp = raw.stamp;
  frame.camera = raw.rectified;
  if (!result.color_message || outputs_->hasPointSubscriber()) {
    raw.color = colorFromMessage(*images.color);
    frame.color = ingest_->color(raw);
  }
  result.depth_message = blankDepth(raw.rectified, header);
  frame.depth = depthIn(result.depth_message.get());
  ingest_->depth(raw, &frame.depth);
  return result;
}

}  // namespace softbody
