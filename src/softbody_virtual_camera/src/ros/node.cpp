#include "ros/node.h"

#include <sys/resource.h>

#include <fmt/format.h>
#include <ros/init.h>
#include <ros/names.h>
#include <ros/package.h>
#include <tf2_msgs/TFMessage.h>

#include <cmath>

#include "softbody_common/protocol/topics.h"
#include "softbody_common/ros/ros_parameters.h"
#include "softbody_common/ros/run_node.h"
#include "softbody_virtual_camera/ros/messages.h"

namespace softbody::virtual_camera {
namespace {

constexpr int kQueue = 2;

/// @param setup has the defaults.
NodeOptions readNodeOptions(const ros::NodeHandle& private_node, const CameraSetup& setup) {
  Parameters given = readParameters(private_node);
  NodeOptions initial;
  initial.setup = setup;
  NodeOptions options = nodeParameters().read(given, initial);
  if (!options.noise) options.setup.noise = noNoise();
  warnUnknown(given);
  return options;
}

}  // namespace

VirtualCameraNode::VirtualCameraNode(ros::NodeHandle node, const ros::NodeHandle& private_node,
                                     const CameraSetup& setup)
    : options_(readNodeOptions(private_node, setup)) {
  std::vector<std::string> warnings;
  camera_.emplace(makeCamera(options_.setup, &warnings));
  for (const std::string& warning : warnings) ROS_WARN("%s", warning.c_str());

  // In a manager with a namespace, roscpp does not resolve names of the root namespace.
  advertise(node, ros::names::parentNamespace(private_node.getNamespace()));
  publishLatched(0, ros::Time::now());
  ahead_.emplace([this](int frame) { return render(frame); });
  ahead_->start(frame_, ros::Time::now());
  timer_ = node.createTimer(ros::Duration(1.0 / options_.setup.rate_hz), &VirtualCameraNode::onTimer, this);
  diagnostics_.emplace(node, private_node, "frames", [this](auto& status) { diagnose(status); });
}

void VirtualCameraNode::advertise(ros::NodeHandle node, const std::string& name_space) {
  const auto name = [&](const char* topic) { return ros::names::append(name_space, topic); };
  image_transport::ImageTransport images(node);
  color_ = images.advertise(name(topics::kCameraColor), kQueue);
  color_info_ = node.advertise<sensor_msgs::CameraInfo>(name(topics::kCameraColorInfo), kQueue);
  depth_ = images.advertise(name(topics::kCameraDepth), kQueue);
  depth_info_ = node.advertise<sensor_msgs::CameraInfo>(name(topics::kCameraDepthInfo), kQueue);
  truth_topology_ = node.advertise<softbody_msgs::MeshTopology>(name(kTruthTopologyTopic), 1, true);
  if (camera_->scene().second) {
    second_topology_ = node.advertise<softbody_msgs::MeshTopology>(name(kSecondTopologyTopic), 1, true);
    second_state_ = node.advertise<softbody_msgs::MeshState>(name(kSecondStateTopic), kQueue);
  }
  truth_camera_ = node.advertise<geometry_msgs::PoseStamped>(name(kTruthCameraPoseTopic), kQueue);
  truth_labels_ = images.advertise(name(kTruthLabelsTopic), kQueue);
  truth_state_ = node.advertise<softbody_msgs::MeshState>(name(kTruthStateTopic), kQueue);
  if (camera_->scene().state(0.0).forces)
    truth_forces_ = node.advertise<softbody_msgs::Forces>(name(kTruthForcesTopic), kQueue);
  if (camera_->scene().state(0.0).T_camera_tool) {
    truth_tool_ = node.advertise<geometry_msgs::PoseStamped>(name(kTruthToolPoseTopic), kQueue);
    truth_cut_ = node.advertise<softbody_msgs::Cut>(name(kTruthCutTopic), kQueue);
  }
  if (camera_->scene().state(0.0).gripper) gripper_ = node.advertise<std_msgs::Bool>(kGripperTopic, kQueue);
  if (camera_->scene().material)
    truth_material_ = node.advertise<std_msgs::String>(name(kTruthMaterialTopic), 1, true);
  for (const ContactWrench& wrench : camera_->scene().state(0.0).wrenches) {
    wrenches_[wrench.name] = node.advertise<geometry_msgs::WrenchStamped>(kWrenchTopic + wrench.name, kQueue);
    true_wrenches_[wrench.name] =
        node.advertise<geometry_msgs::WrenchStamped>(name(kTruthWrenchTopic) + wrench.name, kQueue);
  }
  tf_ = node.advertise<tf2_msgs::TFMessage>("/tf", kQueue);
  if (options_.publish_camera_tf) tf_static_ = node.advertise<tf2_msgs::TFMessage>("/tf_static", 1, true);
}

void VirtualCameraNode::publishLatched(std::uint32_t revision, const ros::Time& stamp) {
  if (options_.publish_camera_tf) tf_static_.publish(staticTransforms(camera_->scene(), stamp));
  if (const auto& material = camera_->scene().material) truth_material_.publish(materialMessage(*material));
  truth_topology_.publish(topologyMessage(camera_->topology(revision), stamp));
  if (const auto second = camera_->secondTopology())
    second_topology_.publish(topologyMessage(*second, stamp, kSecondFrame));
}

bool VirtualCameraNode::hasSubscribers() const {
  return color_.getNumSubscribers() + depth_.getNumSubscribers() + truth_state_.getNumSubscribers() +
             truth_labels_.getNumSubscribers() >
         0;
}

double VirtualCameraNode::sceneTime(int frame) const {
  return std::max(0.0, frame / options_.setup.rate_hz - options_.hold_s);
}

CaptureMessages VirtualCameraNode::render(int frame) {
  return toMessages(camera_->capture(frame, sceneTime(frame)), camera_->pinhole(), ros::Time(),
                    static_cast<std::uint32_t>(frame));
}

void VirtualCameraNode::onTimer(const ros::TimerEvent& event) {
  if (!hasSubscribers()) return;
  if (!options_.loop && sceneTime(frame_) >= camera_->scene().duration_s) {
    ROS_INFO("scene %s is over", options_.setup.scene.c_str());
    timer_.stop();
    over_ = true;
    return;
  }
  const CaptureMessages messages = ahead_->take();
  publish(messages, messages.color->header.stamp);
  const ros::Duration period(1.0 / options_.setup.rate_hz);
  ++published_;
  late_ += ros::Time::now() - event.current_expected > period ? 1 : 0;
  ahead_->start(++frame_, event.current_expected + period);
}

void VirtualCameraNode::diagnose(NodeDiagnostics::Status& status) {
  using diagnostic_msgs::DiagnosticStatus;
  const ros::WallTime now = ros::WallTime::now();
  const double rate_hz = published_ / std::max(1e-3, (now - last_diagnosis_).toSec());
  if (over_)
    status.summary(DiagnosticStatus::OK, "the scene is over");
  else if (!hasSubscribers())
    status.summary(DiagnosticStatus::OK, "nobody subscribes, so no frame is made");
  else if (late_ > 0)
    status.summary(
        DiagnosticStatus::WARN,
        fmt::format("{} of {} frames came late: this machine is too slow for {:g} frames a second of "
                    "{}x{}; set a lower rate, width or height",
                    late_, published_, options_.setup.rate_hz, options_.setup.width, options_.setup.height));
  else
    status.summary(DiagnosticStatus::OK, fmt::format("{:.1f} frames a second", rate_hz));
  status.add("scene", options_.setup.scene);
  status.add("frames per second", fmt::format("{:.1f}", rate_hz));
  status.add("frames late", late_);
  published_ = late_ = 0;
  last_diagnosis_ = now;
}

void VirtualCameraNode::publish(const CaptureMessages& messages, const ros::Time& stamp) {
  const bool edited = messages.truth->revision != revision_;
  for (; revision_ < messages.truth->revision; ++revision_) {
    truth_cut_.publish(cutMessage(camera_->scene().edits.at(revision_), stamp));
  }
  if (edited || frame_ % std::max(1, static_cast<int>(std::lround(options_.setup.rate_hz))) == 0) {
    publishLatched(revision_, stamp);
  }
  tf_.publish(messages.transforms);
  if (messages.gripper_closed) gripper_.publish(messages.gripper_closed);
  if (messages.forces) truth_forces_.publish(messages.forces);
  for (const auto& [thing, wrench] : messages.wrenches) wrenches_.at(thing).publish(wrench);
  for (const auto& [thing, wrench] : messages.true_wrenches) true_wrenches_.at(thing).publish(wrench);
  if (messages.second) second_state_.publish(messages.second);
  truth_camera_.publish(messages.camera);
  if (messages.tool) truth_tool_.publish(messages.tool);
  color_info_.publish(messages.info);
  depth_info_.publish(messages.info);
  color_.publish(messages.color);
  depth_.publish(messages.depth);
  truth_labels_.publish(messages.labels);
  truth_state_.publish(messages.truth);
}

CameraSetup shippedSetup() {
  CameraSetup setup;
  setup.config_folder = ros::package::getPath("softbody_bringup") + "/config";
  return setup;
}

int runNode(int argc, char** argv, const CameraSetup& setup) {
  // A real camera takes no time from the tracker. Threads that OpenCV makes later inherit it.
  constexpr int kNiceness = 10;
  setpriority(PRIO_PROCESS, 0, kNiceness);
  logLineByLine();
  ros::init(argc, argv, "virtual_camera");
  VirtualCameraNode node(ros::NodeHandle(), ros::NodeHandle("~"), setup);
  ros::spin();
  return 0;
}

}  // namespace softbody::virtual_camera
