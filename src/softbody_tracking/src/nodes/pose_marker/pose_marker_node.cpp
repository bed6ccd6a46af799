#include "nodes/pose_marker/pose_marker_node.h"

#include <fmt/format.h>
#include <softbody_msgs/SetPose.h>

#include <stdexcept>

#include "softbody_common/protocol/topics.h"
#include "softbody_common/ros/frame_name.h"
#include "softbody_common/ros/geometry_messages.h"
#include "softbody_common/ros/ros_parameters.h"
#include "softbody_tracking/ros/node_options.h"

namespace softbody {
namespace {

constexpr char kService[] = "feature_tracker/set_pose";  // ~set_pose of the feature tracker in this namespace
constexpr double kWarningPeriod_s = 4.0;                 // [s] between two warnings about a missing input

bool isGiven(const geometry_msgs::Pose& pose) {
  const geometry_msgs::Quaternion& q = pose.orientation;
  return q.x != 0.0 || q.y != 0.0 || q.z != 0.0 || q.w != 0.0;
}

}  // namespace

PoseMarkerNode::PoseMarkerNode(ros::NodeHandle handle, const ros::NodeHandle& private_handle)
    : set_pose_(handle.serviceClient<softbody_msgs::SetPose>(kService)),
      marker_(handle, [this](const auto& feedback) { restartTracking(feedback); }),
      diagnostics_(handle, private_handle, "marker", [this](auto& status) { diagnose(status); }) {
  frame_ = frameName(readOptions(private_handle, poseMarkerNodeParameters()).frame, "parameter frame");
  volume_topology_subscriber_ =
      handle.subscribe(topics::kVolumeTopology, 1, &PoseMarkerNode::onVolumeTopology, this);
  surface_topology_subscriber_ =
      handle.subscribe(topics::kSurfaceTopology, 1, &PoseMarkerNode::onSurfaceTopology, this);
  if (frame_.empty()) info_subscriber_ = handle.subscribe(topics::kRgbInfo, 1, &PoseMarkerNode::onInfo, this);
  // A wall timer: ROS time does not advance while a bag is paused.
  warning_timer_ =
      handle.createWallTimer(ros::WallDuration(kWarningPeriod_s), [this](const auto&) { warnIfNotShown(); });
}

/// The marker needs the body's shape and a frame. Empty: it is shown.
std::string PoseMarkerNode::whyNotShown() const {
  if (marker_.isShown()) return "";
  const bool has_frame = !frame_.empty();
  const ros::Subscriber& missing = has_frame ? surface_topology_subscriber_ : info_subscriber_;
  return fmt::format("the marker waits for {}, {} (publishers: {})",
                     has_frame ? "the body's shape" : "the images' frame", missing.getTopic(),
                     missing.getNumPublishers());
}

void PoseMarkerNode::warnIfNotShown() {
  const std::string why = whyNotShown();
  if (why.empty()) return warning_timer_.stop();
  ROS_WARN_STREAM(why);
}

void PoseMarkerNode::diagnose(NodeDiagnostics::Status& status) const {
  using diagnostic_msgs::DiagnosticStatus;
  const std::string why = whyNotShown();
  if (why.empty())
    status.summary(DiagnosticStatus::OK, "the marker is shown");
  else
    status.summary(DiagnosticStatus::WARN, why);
  status.add("frame", frame_);
}

void PoseMarkerNode::onInfo(const sensor_msgs::CameraInfo::ConstPtr& message) {
  if (message->header.frame_id.empty()) return;
  info_subscriber_.shutdown();  // a camera keeps its frame
  frame_ = message->header.frame_id;
}

void PoseMarkerNode::onVolumeTopology(const softbody_msgs::TetTopology::ConstPtr& message) try {
  // The topology is sent again every second; another object may have another pose.
  if (message->initial_pose == initial_pose_) return;
  initial_pose_ = message->initial_pose;
  if (isGiven(initial_pose_)) marker_.setStartPose(toMessage(fromMessage(initial_pose_)));
} catch (const std::invalid_argument& error) {
  ROS_ERROR_STREAM_THROTTLE(5.0, volume_topology_subscriber_.getTopic()
                                     << " is not used: " << error.what() << "; rostopic info "
                                     << volume_topology_subscriber_.getTopic() << " names the sender");
}

void PoseMarkerNode::onSurfaceTopology(const softbody_msgs::MeshTopology::ConstPtr& message) try {
  // Without a frame the marker waits: the topology is sent again every second.
  if (!frame_.empty()) marker_.show(message, frame_);
} catch (const std::exception& error) {
  ROS_ERROR_STREAM_THROTTLE(5.0, surface_topology_subscriber_.getTopic() << " is unusable: " << error.what());
}

void PoseMarkerNode::restartTracking(const PoseMarker::Feedback& feedback) {
  softbody_msgs::SetPose call;
  call.request.pose.header.frame_id = feedback.header.frame_id;  // stamp 0: the latest transform counts
  call.request.pose.pose = feedback.pose;
  if (!set_pose_.call(call)) {
    ROS_WARN_STREAM("the service " << set_pose_.getService()
                                   << " does not answer; check that feature_tracker runs");
  } else if (!call.response.success) {
    ROS_WARN_STREAM(call.response.message);
  }
}

}  // namespace softbody
