#include "softbody_virtual_camera/ros/node.h"

#include <ros/init.h>
#include <tf2_msgs/TFMessage.h>

#include <cmath>

#include "softbody_common/ros/ros_parameters.h"
#include "softbody_common/topics.h"
#include "softbody_virtual_camera/camera/camera_motion.h"
#include "softbody_virtual_camera/ros/messages.h"
#include "softbody_virtual_camera/textures/contrast.h"

namespace softbody::virtual_camera {
namespace {

constexpr int kQueue = 2;

CameraSetup readSetup(const CameraSetup& defaults, Parameters* parameters) {
  CameraSetup setup = defaults;
  setup.scene = parameters->choice("scene", setup.scene, sceneNames());
  setup.camera_motion = parameters->choice("camera_motion", setup.camera_motion, cameraMotionNames());
  setup.texture = parameters->choice("texture", setup.texture, textureNames());
  setup.body = parameters->text("body", setup.body);
  setup.tool = parameters->text("tool", setup.tool);
  setup.unit = parameters->choice("unit", setup.unit, {"m", "cm", "mm", "inch"});
  setup.seed =
      static_cast<std::uint64_t>(parameters->integer("seed", static_cast<int>(setup.seed), 0, 1 << 30));
  setup.width = parameters->integer("width", setup.width, 16, 4096);
  setup.height = parameters->integer("height", setup.height, 16, 4096);
  setup.rate_hz = parameters->number("rate", setup.rate_hz, 0.1, 1000.0);
  if (!parameters->flag("noise", true)) setup.noise = noNoise();
  return setup;
}

}  // namespace

VirtualCameraNode::VirtualCameraNode(ros::NodeHandle node, const ros::NodeHandle& private_node,
                                     const CameraSetup& setup) {
  Parameters parameters = readParameters(private_node);
  setup_ = readSetup(setup, &parameters);
  loop_ = parameters.flag("loop", true);
  publish_camera_tf_ = parameters.flag("publish_camera_tf", true);
  hold_s_ = parameters.number("hold", hold_s_, 0.0, 3600.0);
  warnUnknown(parameters);
  std::vector<std::string> warnings;
  camera_.emplace(makeCamera(setup_, &warnings));
  for (const std::string& warning : warnings) ROS_WARN("%s", warning.c_str());

  color_ = node.advertise<sensor_msgs::Image>(topics::kCameraColor, kQueue);
  color_info_ = node.advertise<sensor_msgs::CameraInfo>(topics::kCameraColorInfo, kQueue);
  depth_ = node.advertise<sensor_msgs::Image>(topics::kCameraDepth, kQueue);
  depth_info_ = node.advertise<sensor_msgs::CameraInfo>(topics::kCameraDepthInfo, kQueue);
  truth_topology_ = node.advertise<softbody_msgs::MeshTopology>(kTruthTopologyTopic, 1, true);
  truth_state_ = node.advertise<softbody_msgs::MeshState>(kTruthStateTopic, kQueue);
  if (camera_->scene().state(0.0).T_camera_tool) {
    truth_tool_ = node.advertise<geometry_msgs::PoseStamped>(kTruthToolPoseTopic, kQueue);
    truth_cut_ = node.advertise<softbody_msgs::Cut>(kTruthCutTopic, kQueue);
  }
  tf_ = node.advertise<tf2_msgs::TFMessage>("/tf", kQueue);
  if (publish_camera_tf_) tf_static_ = node.advertise<tf2_msgs::TFMessage>("/tf_static", 1, true);
  publishLatched(0, ros::Time::now());
  timer_ = node.createTimer(ros::Duration(1.0 / setup_.rate_hz), &VirtualCameraNode::publishFrame, this);
}

void VirtualCameraNode::publishLatched(std::uint32_t revision, const ros::Time& stamp) {
  if (publish_camera_tf_) tf_static_.publish(opticalFrameTransform(stamp));
  truth_topology_.publish(topologyMessage(camera_->topology(revision), stamp));
}

bool VirtualCameraNode::hasSubscribers() const {
  return color_.getNumSubscribers() + depth_.getNumSubscribers() + truth_state_.getNumSubscribers() > 0;
}

void VirtualCameraNode::publishFrame(const ros::TimerEvent&) {
  if (!hasSubscribers()) return;
  const ros::Time stamp = ros::Time::now();
  const double t = std::max(0.0, frame_ / setup_.rate_hz - hold_s_);
  if (!loop_ && t >= camera_->scene().duration_s) {
    ROS_INFO("scene %s is over", setup_.scene.c_str());
    timer_.stop();
    return;
  }
  const CaptureMessages messages =
      toMessages(camera_->capture(frame_, t), camera_->pinhole(), stamp, static_cast<std::uint32_t>(frame_));
  const bool edited = messages.truth->revision != revision_;
  for (; revision_ < messages.truth->revision; ++revision_) {
    truth_cut_.publish(cutMessage(camera_->scene().edits.at(revision_), stamp));
  }
  if (edited || frame_ % std::max(1, static_cast<int>(std::lround(setup_.rate_hz))) == 0) {
    publishLatched(revision_, stamp);
  }
  tf_.publish(messages.transforms);
  if (messages.tool) truth_tool_.publish(messages.tool);
  color_info_.publish(messages.info);
  depth_info_.publish(messages.info);
  color_.publish(messages.color);
  depth_.publish(messages.depth);
  truth_state_.publish(messages.truth);
  ++frame_;
}

int runNode(int argc, char** argv, const CameraSetup& setup) {
  ros::init(argc, argv, "virtual_camera");
  VirtualCameraNode node(ros::NodeHandle(), ros::NodeHandle("~"), setup);
  ros::spin();
  return 0;
}

}  // namespace softbody::virtual_camera
