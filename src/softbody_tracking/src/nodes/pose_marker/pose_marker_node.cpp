#include "nodes/pose_marker/pose_marker_node.h"

#include <softbody_msgs/SetPose.h>

#include "softbody_common/ros/ros_parameters.h"
#include "softbody_common/topics.h"
#include "softbody_tracking/ros/pose_marker_message.h"

namespace softbody {
namespace {

constexpr char kTopics[] = "pose_marker";
constexpr char kService[] = "feature_tracker/set_pose";
constexpr double kPatience_s = 5.0;
constexpr double kAhead_m = 0.5;  // of the camera, where no pose is known

bool isGiven(const geometry_msgs::Pose& pose) {
  const geometry_msgs::Quaternion& q = pose.orientation;
  return q.x != 0.0 || q.y != 0.0 || q.z != 0.0 || q.w != 0.0;
}

}  // namespace

PoseMarkerNode::PoseMarkerNode(ros::NodeHandle handle, const ros::NodeHandle& private_handle)
    : server_(handle.resolveName(kTopics)) {
  Parameters parameters = readParameters(private_handle);
  frame_ = parameters.text("frame", "");
  warnUnknown(parameters);
  start_.position.z = kAhead_m;
  start_.orientation.w = 1.0;
  menu_.insert("track from here",
               [this](const visualization_msgs::InteractiveMarkerFeedbackConstPtr& f) { track(*f); });
  set_pose_ = handle.serviceClient<softbody_msgs::SetPose>(kService);
  volume_topology_subscriber_ =
      handle.subscribe(topics::kVolumeTopology, 1, &PoseMarkerNode::onVolumeTopology, this);
  surface_topology_subscriber_ =
      handle.subscribe(topics::kSurfaceTopology, 1, &PoseMarkerNode::onSurfaceTopology, this);
  if (frame_.empty()) info_subscriber_ = handle.subscribe(topics::kRgbInfo, 1, &PoseMarkerNode::onInfo, this);
  // Wall time: the time of a bag that is held stands still.
  watch_timer_ = handle.createWallTimer(ros::WallDuration(kPatience_s), [this](const auto&) { watch(); });
}

/// The marker needs the body's shape and a frame to stand in.
void PoseMarkerNode::watch() {
  if (mesh_) return watch_timer_.stop();
  const bool framed = !frame_.empty();
  const ros::Subscriber& missing = framed ? surface_topology_subscriber_ : info_subscriber_;
  ROS_WARN_STREAM("the marker waits for " << (framed ? "the body's shape, " : "the images' frame, ")
                                          << missing.getTopic()
                                          << " (publishers: " << missing.getNumPublishers() << ")");
}

void PoseMarkerNode::onInfo(const sensor_msgs::CameraInfo::ConstPtr& message) {
  info_subscriber_.shutdown();  // a camera keeps its frame
  frame_ = message->header.frame_id;
}

void PoseMarkerNode::onVolumeTopology(const softbody_msgs::TetTopology::ConstPtr& message) {
  volume_topology_subscriber_.shutdown();  // only for where to begin
  if (!isGiven(message->initial_pose)) return;
  start_ = message->initial_pose;
  if (!mesh_) return;
  server_.setPose("body", start_);
  server_.applyChanges();
}

void PoseMarkerNode::onSurfaceTopology(const softbody_msgs::MeshTopology::ConstPtr& message) try {
  // The topology is sent again every second: then the camera's frame may be known, and only a new one counts.
  if (frame_.empty()) return;
  if (mesh_ && mesh_->revision == message->revision && mesh_->rest_vertices == message->rest_vertices &&
      mesh_->triangles == message->triangles)
    return;
  geometry_msgs::PoseStamped pose;
  pose.header.frame_id = frame_;
  pose.pose = start_;
  visualization_msgs::InteractiveMarker shown;
  if (server_.get("body", shown)) {
    pose.header = shown.header;
    pose.pose = shown.pose;
  }
  // Further clients see it move, too.
  server_.insert(makePoseMarker(*message, pose),
                 [this](const visualization_msgs::InteractiveMarkerFeedbackConstPtr& feedback) {
                   if (feedback->event_type == feedback->POSE_UPDATE) server_.applyChanges();
                 });
  menu_.apply(server_, "body");
  server_.applyChanges();
  mesh_ = message;
} catch (const std::exception& error) {
  ROS_ERROR_STREAM_THROTTLE(5.0, surface_topology_subscriber_.getTopic() << " is unusable: " << error.what());
}

void PoseMarkerNode::track(const visualization_msgs::InteractiveMarkerFeedback& feedback) {
  softbody_msgs::SetPose call;
  call.request.pose.header.frame_id = feedback.header.frame_id;  // at whatever time tf knows it
  call.request.pose.pose = feedback.pose;
  if (!set_pose_.call(call)) {
    ROS_WARN_STREAM("the service " << set_pose_.getService() << " does not answer");
  } else if (!call.response.success) {
    ROS_WARN_STREAM(call.response.message);
  }
}

}  // namespace softbody
