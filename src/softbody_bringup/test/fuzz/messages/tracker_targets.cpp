#include <fmt/format.h>
#include <geometry_msgs/PolygonStamped.h>
#include <softbody_msgs/MeshTopology.h>
#include <softbody_msgs/SetPose.h>
#include <softbody_msgs/Targets.h>
#include <softbody_msgs/TrackingStatus.h>
#include <std_srvs/Trigger.h>
#include <tf2_msgs/TFMessage.h>

#include "fuzz/messages/camera_frames.h"
#include "fuzz/messages/target.h"
#include "softbody_common/geometry/rigid_fit.h"
#include "softbody_common/protocol/topics.h"
#include "softbody_common/ros/conversions.h"
#include "softbody_sim/object/object_model.h"
#include "softbody_tracking/ros/nodes.h"

namespace softbody::fuzz {
namespace {

constexpr int kWidth = 160, kHeight = 120;
constexpr char kOptical[] = "camera_color_optical_frame", kWorld[] = "world", kKnown[] = "other/surface";

const ObjectModel& sponge() {
  static const ObjectModel model = buildObjectModel(loadObjectDescription(CONFIG_DIR "/sponge.yaml"));
  return model;
}

XmlRpc::XmlRpcValue trackerParameters(bool placed) {
  XmlRpc::XmlRpcValue parameters;
  parameters["use_mask"] = placed;
  parameters["tf_timeout_s"] = 0.01;  // frames that tf does not know come often
  if (!placed) return parameters;
  parameters["output_frame"] = std::string(kWorld);
  parameters["mask_timeout_s"] = 0.001;
  parameters["known_surfaces"][0] = std::string("/softbody/") + kKnown;
  return parameters;
}

class TrackerTarget : public Target {
 public:
  /// @param placed with masks, and the body in the world's frame.
  explicit TrackerTarget(bool placed)
      : frame_(placed ? kWorld : kOptical),
        with_masks_(placed),
        frames_("bend", kWidth, kHeight, {0.0, 0.02}, true),
        node_("feature_tracker", trackerParameters(placed), makeFeatureTracker),
        status_(&node_, topics::kStatus),
        targets_(&node_, topics::kTargets),
        set_pose_(addService<softbody_msgs::SetPose>(&node_, "set_pose", [this] { return pose(); })),
        parameters_(addParameters(&node_)) {
    auto images = std::make_unique<FrameInput>(&node_, kRectifiedTopics, &frames_);
    images_ = images.get();
    inputs.push_back({std::move(images), 200});
    volume_ =
        add<softbody_msgs::TetTopology>(&node_, topics::kVolumeTopology, 40, [this] { return volume(); });
    surface_ =
        add<softbody_msgs::MeshTopology>(&node_, topics::kSurfaceTopology, 40, [this] { return surface(); });
    state_ = add<softbody_msgs::MeshState>(&node_, topics::kVolumeState, 300, [this] { return state(); });
    add<geometry_msgs::PolygonStamped>(&node_, topics::kToolBlade, 200, [] { return blade(); });
    if (placed) {
      known_surface_ = add<softbody_msgs::MeshTopology>(&node_, kKnown + std::string("/topology"), 20,
                                                        [] { return toMessage(sponge().visual); });
      known_state_ = add<softbody_msgs::MeshState>(&node_, kKnown + std::string("/state"), 50,
                                                   [this] { return farAway(); });
      mask_ = add<sensor_msgs::Image>(&node_, topics::kMask, 200, [this] { return mask(); });
      tf_ = add<tf2_msgs::TFMessage>(&node_, "/tf_static", 20, [] { return cameraInWorld(); });
      tf_->sendGood();
      ros::WallDuration(0.05).sleep();  // tf has a thread of its own
    }
    addService<std_srvs::Trigger>(&node_, "find_again", [] { return std_srvs::Trigger::Request(); });
  }

  std::string check() override {
    revision_ = 0;
    parameters_->sendGood();
    if (tf_ != nullptr) tf_->sendGood();
    volume_->sendGood();
    surface_->sendGood();
    if (known_surface_ != nullptr) known_surface_->sendGood();
    for (int i = 0; i < kGoodFrames; ++i) {
      // As a person does who sees that the body is lost.
      if (i == kGoodFrames / 4 || i == kGoodFrames / 2) set_pose_->sendGood();
      images_->giveGood();
      if (mask_ != nullptr) mask_->sendGood();
      if (known_state_ != nullptr) known_state_->sendGood();
      state_->sendGood();
    }
    if (status_.get() == nullptr) return "no status comes";
    if (!status_.hasStamp(LoneRos::instance().now())) return "no status of the last frame";
    if (status_.get()->state != softbody_msgs::TrackingStatus::TRACKING)
      return "the body is not tracked: " + status_.get()->reason;
    return targets_.hasStamp(LoneRos::instance().now()) ? "" : "no targets";
  }

 private:
  static constexpr int kGoodFrames = 60;

  std::uint32_t revision() {
    if (choice_.oneIn(50)) ++revision_;
    return revision_;
  }

  softbody_msgs::TetTopology volume() {
    softbody_msgs::TetTopology message = toMessage(sponge().volume);
    message.header.stamp = LoneRos::instance().now();
    message.revision = revision();
    return message;
  }

  softbody_msgs::MeshTopology surface() {
    softbody_msgs::MeshTopology message = toMessage(sponge().visual);
    message.header.stamp = LoneRos::instance().now();
    message.revision = revision();
    return message;
  }

  softbody_msgs::MeshState state() {
    return stateOf(transformed(sponge().volume.rest_vertices, bodyPose()), revision_);
  }

  /// Another body, which hides nothing.
  softbody_msgs::MeshState farAway() { return stateOf(sponge().visual.rest_vertices.array() + 5.0, 0); }

  softbody_msgs::MeshState stateOf(const Points& vertices, std::uint32_t revision) const {
    MeshState state;
    state.revision = revision;
    state.vertices = vertices;
    state.confidence.assign(static_cast<std::size_t>(state.vertices.rows()), 1.0f);
    softbody_msgs::MeshState message = toMessage(state);
    message.header.frame_id = frame_;
    message.header.stamp = message.observed = LoneRos::instance().now();
    return message;
  }

  static geometry_msgs::PolygonStamped blade() {
    geometry_msgs::PolygonStamped message;
    message.header.stamp = LoneRos::instance().now();
    message.header.frame_id = kOptical;
    for (const auto& [x, y] : {std::pair(0.0f, 0.0f), std::pair(0.02f, 0.0f), std::pair(0.02f, 0.02f)}) {
      geometry_msgs::Point32 corner;
      corner.x = x;
      corner.y = y;
      corner.z = 0.4f;
      message.polygon.points.push_back(corner);
    }
    return message;
  }

  sensor_msgs::Image mask() const {
    sensor_msgs::Image mask;
    mask.header.stamp = LoneRos::instance().now();
    mask.width = mask.step = kWidth;
    mask.height = kHeight;
    mask.encoding = "mono8";
    mask.data.assign(kWidth * kHeight, 255);
    return mask;
  }

  softbody_msgs::SetPose::Request pose() const {
    softbody_msgs::SetPose::Request request;
    request.pose.header.frame_id = frame_;
    request.pose.pose = toMessage(bodyPose());
    return request;
  }

  static Eigen::Isometry3d cameraPose() { return Eigen::Isometry3d(Eigen::Translation3d(0.1, 0.2, 0.3)); }

  static tf2_msgs::TFMessage cameraInWorld() {
    geometry_msgs::TransformStamped transform;
    transform.header.frame_id = kWorld;
    transform.header.stamp = LoneRos::instance().now();
    transform.child_frame_id = kOptical;
    transform.transform.translation.x = cameraPose().translation().x();
    transform.transform.translation.y = cameraPose().translation().y();
    transform.transform.translation.z = cameraPose().translation().z();
    transform.transform.rotation.w = 1.0;
    tf2_msgs::TFMessage message;
    message.transforms.push_back(transform);
    return message;
  }

  Eigen::Isometry3d bodyPose() const {
    return with_masks_ ? cameraPose() * frames_.bodyPose() : frames_.bodyPose();
  }

  Choice choice_{5};
  std::string frame_;  ///< of the body
  bool with_masks_;
  std::uint32_t revision_ = 0;
  CameraFrames frames_;
  DrivenNode node_;
  Newest<softbody_msgs::TrackingStatus> status_;
  Newest<softbody_msgs::Targets> targets_;
  ServiceInput<softbody_msgs::SetPose>* set_pose_;
  ParameterInput* parameters_;
  FrameInput* images_;
  TopicInput<softbody_msgs::TetTopology>* volume_;
  TopicInput<softbody_msgs::MeshTopology>* surface_;
  TopicInput<softbody_msgs::MeshState>* state_;
  TopicInput<softbody_msgs::MeshTopology>* known_surface_ = nullptr;
  TopicInput<softbody_msgs::MeshState>* known_state_ = nullptr;
  TopicInput<sensor_msgs::Image>* mask_ = nullptr;
  TopicInput<tf2_msgs::TFMessage>* tf_ = nullptr;
};

}  // namespace

std::unique_ptr<Target> makeTrackerTarget() { return std::make_unique<TrackerTarget>(false); }
std::unique_ptr<Target> makePlacedTrackerTarget() { return std::make_unique<TrackerTarget>(true); }

}  // namespace softbody::fuzz
