#include "nodes/pose_marker/pose_marker.h"

#include "softbody_tracking/ros/pose_marker_message.h"

namespace softbody {
namespace {

constexpr char kTopicNamespace[] =
    "pose_marker";                          // of the interactive marker's topics; users' rviz files name it
constexpr char kMarkerName[] = "body";      // as makePoseMarker names it
constexpr double kDefaultDistance_m = 0.5;  // [m] before the camera, if the object has no initial pose

}  // namespace

PoseMarker::PoseMarker(const ros::NodeHandle& handle, const Callback& on_track)
    : server_(handle.resolveName(kTopicNamespace)) {
  start_pose_.position.z = kDefaultDistance_m;
  start_pose_.orientation.w = 1.0;
  menu_.insert("track from here", [on_track](const auto& feedback) { on_track(*feedback); });
}

void PoseMarker::setStartPose(const geometry_msgs::Pose& pose) {
  start_pose_ = pose;
  if (!isShown()) return;
  server_.setPose(kMarkerName, start_pose_);
  server_.applyChanges();
}

bool PoseMarker::isSameMesh(const softbody_msgs::MeshTopology& mesh) const {
  return mesh_ && mesh_->revision == mesh.revision && mesh_->rest_vertices == mesh.rest_vertices &&
         mesh_->triangles == mesh.triangles;
}

void PoseMarker::show(const softbody_msgs::MeshTopology::ConstPtr& mesh, const std::string& frame) {
  if (isSameMesh(*mesh)) return;
  geometry_msgs::PoseStamped pose;
  pose.header.frame_id = frame;
  pose.pose = start_pose_;
  visualization_msgs::InteractiveMarker shown;
  if (server_.get(kMarkerName, shown)) {
    pose.header = shown.header;
    pose.pose = shown.pose;
  }
  // applyChanges() sends the new pose to the other rviz windows too.
  server_.insert(makePoseMarker(*mesh, pose),
                 [this](const visualization_msgs::InteractiveMarkerFeedbackConstPtr& feedback) {
                   if (feedback->event_type == feedback->POSE_UPDATE) server_.applyChanges();
                 });
  menu_.apply(server_, kMarkerName);
  server_.applyChanges();
  mesh_ = mesh;
}

}  // namespace softbody
