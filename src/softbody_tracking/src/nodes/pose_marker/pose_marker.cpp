#include "nodes/pose_marker/pose_marker.h"

#include <stdexcept>
#include <utility>

#include "ros/pose_marker_message.h"
#include "softbody_common/ros/conversions.h"
#include "softbody_common/ros/geometry_messages.h"

namespace softbody {
namespace {

constexpr char kTopicNamespace[] =
    "pose_marker";                          // of the interactive marker's topics; users' rviz files name it
constexpr char kMarkerName[] = "body";      // as makePoseMarker names it
constexpr double kDefaultDistance_m = 0.5;  // [m] before the camera, if the object has no initial pose

}  // namespace

PoseMarker::PoseMarker(const ros::NodeHandle& handle, Callback on_track)
    : on_track_(std::move(on_track)),
      calls_(handle.getCallbackQueue()),
      server_(handle.resolveName(kTopicNamespace)) {
  start_pose_.position.z = kDefaultDistance_m;
  start_pose_.orientation.w = 1.0;
  menu_.insert("track from here", [this](const FeedbackPtr& feedback) {
    calls_.add([this, feedback] { on_track_(*feedback); });
  });
}

void PoseMarker::setStartPose(const geometry_msgs::Pose& pose) {
  start_pose_ = pose_.pose = pose;
  if (!isShown()) return;
  server_.setPose(kMarkerName, pose_.pose, pose_.header);
  server_.applyChanges();
}

/// The server has taken the pose already. A pose that is not usable is taken back.
void PoseMarker::onFeedback(const Feedback& feedback) {
  if (feedback.event_type != Feedback::POSE_UPDATE) return;
  try {
    fromMessage(feedback.pose);
    if (feedback.header.frame_id.empty()) throw std::invalid_argument("its pose has no frame_id");
    pose_.header = feedback.header;
    pose_.pose = feedback.pose;
  } catch (const std::invalid_argument& error) {
    ROS_WARN_STREAM_THROTTLE(5.0, "the marker stays where it is: " << error.what());
    server_.setPose(kMarkerName, pose_.pose, pose_.header);
  }
  server_.applyChanges();  // sends the pose to the other rviz windows too
}

void PoseMarker::show(const softbody_msgs::MeshTopology::ConstPtr& mesh, const std::string& frame) {
  if (mesh_ && sameTopology(*mesh_, *mesh)) return;
  geometry_msgs::PoseStamped pose = pose_;
  if (!isShown()) {
    pose.header.frame_id = frame;
    pose.pose = start_pose_;
  }
  server_.insert(makePoseMarker(*mesh, pose), [this](const FeedbackPtr& feedback) {
    calls_.add([this, feedback] { onFeedback(*feedback); });
  });
  menu_.apply(server_, kMarkerName);
  server_.applyChanges();
  pose_ = pose;
  mesh_ = mesh;
}

}  // namespace softbody
