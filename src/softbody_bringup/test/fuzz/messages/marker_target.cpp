#include <sensor_msgs/CameraInfo.h>
#include <softbody_msgs/MeshTopology.h>
#include <softbody_msgs/TetTopology.h>
#include <visualization_msgs/InteractiveMarkerFeedback.h>
#include <visualization_msgs/InteractiveMarkerUpdate.h>

#include "fuzz/messages/block.h"
#include "fuzz/messages/target.h"
#include "softbody_common/protocol/topics.h"
#include "softbody_common/ros/camera_messages.h"
#include "softbody_common/ros/conversions.h"
#include "softbody_tracking/ros/nodes.h"
#include "softbody_virtual_camera/camera/virtual_camera.h"

namespace softbody::fuzz {
namespace {

using Feedback = visualization_msgs::InteractiveMarkerFeedback;

/// The marker learns its frame and its first pose once, so that the node has to be made again often.
class MarkerTarget : public Target {
 public:
  MarkerTarget()
      : node_("pose_marker", {}, makePoseMarker),
        update_(node_.handle().subscribe<visualization_msgs::InteractiveMarkerUpdate>(
            "pose_marker/update", 10, [this](const auto& message) { onUpdate(*message); })) {
    add<softbody_msgs::TetTopology>(&node_, topics::kVolumeTopology, 2,
                                    [] { return toMessage(block().model.volume); });
    surface_ = add<softbody_msgs::MeshTopology>(&node_, topics::kSurfaceTopology, 6,
                                                [] { return toMessage(block().model.visual); });
    info_ = add<sensor_msgs::CameraInfo>(&node_, topics::kRgbInfo, 2, [] { return info(); });
    feedback_ = add<Feedback>(&node_, "pose_marker/feedback", 10, [this] { return feedback(); });
  }

  /// A new node has had no messages; after others a good mesh is shown, and a good pose is passed on.
  std::string check() override {
    info_->send(info());
    softbody_msgs::MeshTopology mesh = toMessage(block().model.visual);
    mesh.revision = ++revision_;
    surface_->send(mesh);
    move(0.25);
    move(0.5);
    // The server's messages come through another thread.
    const bool moved = node_.processUntil([this] { return shown_x_ == 0.5; });
    return moved ? "" : "the marker does not show the pose that it was moved to";
  }

 private:
  static sensor_msgs::CameraInfo info() {
    sensor_msgs::CameraInfo info = toMessage(virtual_camera::d435(64, 48));
    info.header.frame_id = "camera_color_optical_frame";
    info.header.stamp = LoneRos::instance().now();
    return info;
  }

  Feedback feedback() {
    Feedback feedback;
    feedback.header.frame_id = "camera_color_optical_frame";
    feedback.client_id = "rviz";
    feedback.marker_name = "body";
    const std::uint8_t types[] = {Feedback::POSE_UPDATE, Feedback::MOUSE_DOWN, Feedback::KEEP_ALIVE};
    feedback.event_type = choice_.oneIn(400) ? std::uint8_t{Feedback::MENU_SELECT} : types[choice_.below(3)];
    feedback.menu_entry_id = 1;
    feedback.pose.orientation.w = 1.0;
    return feedback;
  }

  void move(double x) {
    Feedback moved = feedback();
    moved.event_type = Feedback::POSE_UPDATE;
    moved.pose.position.x = x;
    feedback_->send(moved);
    node_.process();
  }

  void onUpdate(const visualization_msgs::InteractiveMarkerUpdate& update) {
    for (const auto& pose : update.poses) shown_x_ = pose.pose.position.x;
  }

  Choice choice_{3};
  std::uint32_t revision_ = 1'000;
  std::optional<double> shown_x_;
  DrivenNode node_;
  ros::Subscriber update_;
  TopicInput<softbody_msgs::MeshTopology>* surface_;
  TopicInput<sensor_msgs::CameraInfo>* info_;
  TopicInput<Feedback>* feedback_;
};

}  // namespace

std::unique_ptr<Target> makeMarkerTarget() { return std::make_unique<MarkerTarget>(); }

}  // namespace softbody::fuzz
