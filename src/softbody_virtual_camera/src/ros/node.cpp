#include "softbody_virtual_camera/ros/node.h"

#include <sys/resource.h>

#include <fmt/format.h>
#include <ros/init.h>
#include <ros/names.h>
#include <ros/package.h>
#include <tf2_msgs/TFMessage.h>

#include <cmath>

#include "softbody_common/ros/ros_parameters.h"
#include "softbody_common/ros/run_node.h"
#include "softbody_common/topics.h"
#include "softbody_sim/object/material.h"
#include "softbody_virtual_camera/camera/camera_motion.h"
#include "softbody_virtual_camera/catalog/make_scene.h"
#include "softbody_virtual_camera/ros/messages.h"
#include "softbody_virtual_camera/textures/body_paint.h"

namespace softbody::virtual_camera {
namespace {

constexpr int kQueue = 2;

CameraSetup readSetup(const CameraSetup& defaults, Parameters* parameters) {
  CameraSetup setup = defaults;
  const auto optional = [&](const char* key, const MaterialRange& range) {
    return parameters->optionalNumber(key, range.min, range.max);
  };
  setup.scene = parameters->choice("scene", setup.scene, sceneNames());
  setup.camera_motion = parameters->choice("camera_motion", setup.camera_motion, cameraMotionNames());
  setup.texture = parameters->choice("texture", setup.texture, textureNames());
  setup.body = parameters->text("body", setup.body);
  setup.tool = parameters->text("tool", setup.tool);
  setup.sheet = parameters->text("sheet", setup.sheet);
  setup.jerks = parameters->flag("jerks", setup.jerks);
  setup.camera_tf = parameters->flag("camera_tf", setup.camera_tf);
  setup.unit = parameters->choice("unit", setup.unit, {"m", "cm", "mm", "inch"});
  setup.seed =
      static_cast<std::uint64_t>(parameters->integer("seed", static_cast<int>(setup.seed), 0, 1 << 30));
  setup.width = parameters->integer("width", setup.width, 16, 4096);
  setup.height = parameters->integer("height", setup.height, 16, 4096);
  setup.rate_hz = parameters->number("rate", setup.rate_hz, 0.1, 1000.0);
  setup.youngs_modulus_pa = optional("youngs_modulus", kYoungsModulusRange);
  setup.poisson_ratio = optional("poisson_ratio", kPoissonRatioRange);
  setup.density_kg_m3 = optional("density", kDensityRange);
  setup.damping = optional("damping", {kDampingRange.min, 0.99});
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

  // In a manager with a namespace, roscpp does not resolve names of the root namespace.
  advertise(node, ros::names::parentNamespace(private_node.getNamespace()));
  publishLatched(0, ros::Time::now());
  ahead_.emplace([this](int frame) { return render(frame); });
  ahead_->start(frame_, ros::Time::now());
  timer_ = node.createTimer(ros::Duration(1.0 / setup_.rate_hz), &VirtualCameraNode::onTimer, this);
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
  if (publish_camera_tf_) tf_static_ = node.advertise<tf2_msgs::TFMessage>("/tf_static", 1, true);
}

void VirtualCameraNode::publishLatched(std::uint32_t revision, const ros::Time& stamp) {
  if (publish_camera_tf_) tf_static_.publish(staticTransforms(camera_->scene(), stamp));
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
  return std::max(0.0, frame / setup_.rate_hz - hold_s_);
}

CaptureMessages VirtualCameraNode::render(int frame) {
  return toMessages(camera_->capture(frame, sceneTime(frame)), camera_->pinhole(), ros::Time(),
                    static_cast<std::uint32_t>(frame));
}

void VirtualCameraNode::onTimer(const ros::TimerEvent& event) {
  if (!hasSubscribers()) return;
  if (!loop_ && sceneTime(frame_) >= camera_->scene().duration_s) {
    ROS_INFO("scene %s is over", setup_.scene.c_str());
    timer_.stop();
    over_ = true;
    return;
  }
  const CaptureMessages messages = ahead_->take();
  publish(messages, messages.color->header.stamp);
  const ros::Duration period(1.0 / setup_.rate_hz);
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
                    late_, published_, setup_.rate_hz, setup_.width, setup_.height));
  else
    status.summary(DiagnosticStatus::OK, fmt::format("{:.1f} frames a second", rate_hz));
  status.add("scene", setup_.scene);
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
  if (edited || frame_ % std::max(1, static_cast<int>(std::lround(setup_.rate_hz))) == 0) {
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
