#include "softbody_recordings/ros/result_bag.h"

#include <geometry_msgs/PolygonStamped.h>
#include <geometry_msgs/PoseWithCovarianceStamped.h>
#include <softbody_msgs/StageTiming.h>
#include <tf2_eigen/tf2_eigen.h>
#include <tf2_msgs/TFMessage.h>

#include "softbody_common/protocol/topics.h"
#include "softbody_common/ros/conversions.h"
#include "softbody_common/ros/cut_messages.h"
#include "softbody_common/ros/frame_name.h"
#include "softbody_sim/ros/force_messages.h"
#include "softbody_tracking/ros/feature_messages.h"
#include "softbody_tracking/ros/tool_messages.h"

namespace softbody {

ResultBag::ResultBag(AtomicBag* bag, std::string topic_namespace, const ResultBagExtras& extras)
    : namespace_(std::move(topic_namespace)),
      body_frame_(frameInNamespace(namespace_, "softbody")),
      extras_(extras),
      bag_(bag) {}

template <typename Message>
void ResultBag::write(const std::string& topic, Message message, const std_msgs::Header& header) {
  message.header = header;
  message.header.seq = 0;
  bag_->write(topic, header.stamp, message);
}

void ResultBag::writeTopologies(const TetTopology& volume, const MeshTopology& surface,
                                const ros::Time& stamp) {
  if (revision_stamp_.isZero() || volume.revision != revision_) revision_stamp_ = stamp;
  revision_ = volume.revision;
  softbody_msgs::TetTopology tets = toMessage(volume);
  tets.header.frame_id = body_frame_;
  tets.header.stamp = revision_stamp_;
  bag_->writeLatched(topic(topics::kVolumeTopology), stamp, tets);
  softbody_msgs::MeshTopology mesh = toMessage(surface);
  mesh.header = tets.header;
  bag_->writeLatched(topic(topics::kSurfaceTopology), stamp, mesh);
}

void ResultBag::writeTransform(const Eigen::Isometry3d& pose, const std::string& child,
                               const std_msgs::Header& header) {
  geometry_msgs::TransformStamped transform = tf2::eigenToTransform(pose);
  transform.header = header;
  transform.header.seq = 0;
  transform.child_frame_id = child;
  tf2_msgs::TFMessage message;
  message.transforms.push_back(transform);
  bag_->write("/tf", header.stamp, message);
}

void ResultBag::writeTool(const ToolObservation& tool, const std_msgs::Header& header) {
  geometry_msgs::PoseWithCovarianceStamped pose;
  pose.pose = toMessage(tool);
  write(topic(topics::kToolPose), pose, header);
  if (blade_.rows() > 0 && tool.cuts) {
    geometry_msgs::PolygonStamped blade;
    blade.polygon = bladePolygon(blade_, tool.T_camera_tool);
    write(topic(topics::kToolBlade), blade, header);
  }
  if (!tool.ambiguous) writeTransform(tool.T_camera_tool, frameInNamespace(namespace_, "tool"), header);
}

void ResultBag::writeStatus(const TrackingStatus& status, const std_msgs::Header& header) {
  write(topic(topics::kStatus), toMessage(status), header);
}

void ResultBag::writeReaction(const NamedReaction& reaction, const std_msgs::Header& header) {
  const geometry_msgs::WrenchStamped message = toMessage(reaction, header.frame_id);
  std_msgs::Header of_wrench = header;
  of_wrench.frame_id = message.header.frame_id;
  write(topic(topics::kReaction) + reaction.name, message, of_wrench);
}

void ResultBag::writeFrame(const FrameOutput& frame, const std_msgs::Header& header) {
  std_msgs::Header fixed = header;
  if (!output_frame_.empty()) fixed.frame_id = output_frame_;
  if (!frame.predicted) writeStatus(frame.tracking.status, header);
  if (frame.tracking.has_targets) {
    write(topic(topics::kFeatures), makeFeatureCloud(frame.tracking.features), header);
    write(topic(topics::kFeaturesMarker), makeFeatureMarker(frame.tracking.features), header);
    if (extras_.labels) write(topic(topics::kLabels), makeLabelImage(frame.tracking, frame.image), header);
    write(topic(topics::kTargets), toMessage(frame.tracking.targets), fixed);
    writeTransform(frame.T_fixed_camera.inverse() * frame.tracking.targets.body_pose, body_frame_, header);
  }
  if (frame.tool) writeTool(*frame.tool, header);
  std_msgs::Header rest = header;
  rest.frame_id = body_frame_;
  for (const Cut& cut : frame.cuts) write(topic(topics::kCut), toMessage(cut), rest);
  if (frame.volume) write(topic(topics::kVolumeState), toMessage(*frame.volume), fixed);
  if (frame.forces) write(topic(topics::kForces), toMessage(*frame.forces, fixed.frame_id), fixed);
  if (frame.surface) write(topic(topics::kSurfaceState), toMessage(*frame.surface), fixed);
  for (const NamedReaction& reaction : frame.reactions) writeReaction(reaction, fixed);
  if (extras_.timing) write(topic(topics::kTiming), timingMessage("replay", frame.times), header);
}

}  // namespace softbody
