#include "softbody_bringup/result_bag.h"

#include <softbody_msgs/StageTiming.h>
#include <tf2_eigen/tf2_eigen.h>
#include <tf2_msgs/TFMessage.h>

#include "softbody_common/conversions.h"
#include "softbody_common/topics.h"
#include "softbody_tracking/feature_messages.h"

namespace softbody {
ResultBag::ResultBag(std::filesystem::path output, std::string topic_namespace, std::string body_frame,
                     bool with_timing)
    : namespace_(std::move(topic_namespace)),
      body_frame_(std::move(body_frame)),
      with_timing_(with_timing),
      bag_(std::move(output)) {}

template <typename Message>
void ResultBag::write(const std::string& topic, Message message, const std_msgs::Header& header) {
  message.header = header;
  message.header.seq = 0;
  bag_.write(topic, header.stamp, message);
}

void ResultBag::writeTopologies(const Pipeline& pipeline, const ros::Time& stamp) {
  if (first_stamp_.isZero()) first_stamp_ = stamp;
  softbody_msgs::TetTopology volume = toMessage(pipeline.volumeTopology());
  volume.header.frame_id = body_frame_;
  volume.header.stamp = first_stamp_;
  bag_.writeLatched(topic(topics::kVolumeTopology), stamp, volume);
  softbody_msgs::MeshTopology surface = toMessage(pipeline.surfaceTopology());
  surface.header = volume.header;
  bag_.writeLatched(topic(topics::kSurfaceTopology), stamp, surface);
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
    write(topic(topics::kFeaturesMarker), makeFeatureMarker(frame.tracking.features), header);
    write(topic(topics::kTargets), toMessage(frame.tracking.targets), header);
    writeTransform(frame.tracking.targets.body_pose, header);
  }
  if (frame.volume) write(topic(topics::kVolumeState), toMessage(*frame.volume), header);
  if (frame.surface) write(topic(topics::kSurfaceState), toMessage(*frame.surface), header);
  if (with_timing_) write(topic(topics::kTiming), timingMessage("replay", frame.times), header);
}

}  // namespace softbody
