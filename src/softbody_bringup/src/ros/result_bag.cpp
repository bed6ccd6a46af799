#include "softbody_bringup/result_bag.h"

#include <softbody_msgs/StageTiming.h>
#include <tf2_eigen/tf2_eigen.h>
#include <tf2_msgs/TFMessage.h>

#include "softbody_common/conversions.h"
#include "softbody_common/topics.h"
#include "softbody_tracking/feature_messages.h"

namespace softbody {
namespace {

/// The connection header of a latched topic.
template <typename Message>
boost::shared_ptr<ros::M_string> latchedConnection(const std::string& topic) {
  const auto header = boost::make_shared<ros::M_string>();
  (*header)["topic"] = topic;
  (*header)["type"] = ros::message_traits::DataType<Message>::value();
  (*header)["md5sum"] = ros::message_traits::MD5Sum<Message>::value();
  (*header)["message_definition"] = ros::message_traits::Definition<Message>::value();
  (*header)["latching"] = "1";
  return header;
}

}  // namespace

ResultBag::ResultBag(std::filesystem::path output, std::string topic_namespace, std::string body_frame,
                     bool with_timing)
    : output_(std::move(output)),
      temporary_(output_.string() + ".part"),
      namespace_(std::move(topic_namespace)),
      body_frame_(std::move(body_frame)),
      with_timing_(with_timing),
      bag_(temporary_.string(), rosbag::bagmode::Write) {
  bag_.setCompression(rosbag::compression::LZ4);
}

ResultBag::~ResultBag() {
  if (!bag_.isOpen()) return;
  bag_.close();
  std::error_code ignored;
  std::filesystem::remove(temporary_, ignored);
}

void ResultBag::finish() {
  bag_.close();
  std::filesystem::rename(temporary_, output_);
}

template <typename Message>
void ResultBag::write(const std::string& topic, Message message, const std_msgs::Header& header) {
  message.header = header;
  message.header.seq = 0;
  bag_.write(topic, header.stamp, message);
}

void ResultBag::writeTopologies(const Pipeline& pipeline, const ros::Time& stamp) {
  softbody_msgs::TetTopology volume = toMessage(pipeline.volumeTopology());
  volume.header.frame_id = body_frame_;
  volume.header.stamp = stamp;
  bag_.write(topic(topics::kVolumeTopology), stamp, volume,
             latchedConnection<softbody_msgs::TetTopology>(topic(topics::kVolumeTopology)));
  softbody_msgs::MeshTopology surface = toMessage(pipeline.surfaceTopology());
  surface.header = volume.header;
  bag_.write(topic(topics::kSurfaceTopology), stamp, surface,
             latchedConnection<softbody_msgs::MeshTopology>(topic(topics::kSurfaceTopology)));
}

void ResultBag::writeTransform(const Eigen::Isometry3d& body_pose, const std_msgs::Header& header) {
  geometry_msgs::TransformStamped transform = tf2::eigenToTransform(body_pose);
  transform.header = header;
  transform.header.seq = 0;
  transform.child_frame_id = body_frame_;
  tf2_msgs::TFMessage message;
  message.transforms.push_back(transform);
  bag_.write("/tf", header.stamp, message);
}

void ResultBag::writeFrame(const FrameOutput& frame, const std_msgs::Header& header) {
  write(topic(topics::kStatus), toMessage(frame.tracking.status), header);
  if (frame.tracking.has_targets) {
    write(topic(topics::kFeatures), makeFeatureCloud(frame.tracking.features), header);
    write(topic(topics::kTargets), toMessage(frame.tracking.targets), header);
    writeTransform(frame.tracking.targets.body_pose, header);
  }
  if (frame.volume) write(topic(topics::kVolumeState), toMessage(*frame.volume), header);
  if (frame.surface) write(topic(topics::kSurfaceState), toMessage(*frame.surface), header);
  if (with_timing_) write(topic(topics::kTiming), timingMessage("replay", frame.times), header);
}

}  // namespace softbody
