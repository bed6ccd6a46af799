#include "nodes/feature_tracker/feature_tracker_node.h"

#include <cv_bridge/cv_bridge.h>
#include <fmt/format.h>
#include <sensor_msgs/image_encodings.h>
#include <softbody_msgs/StageTiming.h>
#include <softbody_msgs/Targets.h>
#include <softbody_msgs/TrackingStatus.h>
#include <tf2_eigen/tf2_eigen.h>

#include <utility>

#include "nodes/silence.h"
#include "softbody_common/ros/conversions.h"
#include "softbody_common/ros/ros_parameters.h"
#include "softbody_common/topics.h"
#include "softbody_common/tracking_state.h"
#include "softbody_tracking/ros/feature_messages.h"

namespace softbody {
namespace {

constexpr int kBladeQueue = 100;  // of a fast tool, while a frame is tracked
constexpr double kSetPosePatience_s = 0.5;

}  // namespace

FeatureTrackerNode::FeatureTrackerNode(const ros::NodeHandle& handle, ros::NodeHandle private_handle)
    : handle_(handle), diagnostics_(handle, private_handle) {
  Parameters parameters = readParameters(private_handle);
  body_frame_ = parameters.text("body_frame", "softbody");
  output_frame_ = std::make_unique<OutputFrame>(parameters);
  tracker_ = std::make_unique<BodyTracker>(readTrackerConfig(parameters));
  const bool use_mask = parameters.flag("use_mask", false);
  const double mask_timeout_s = parameters.number("mask_timeout_s", 0.3, 0.0, 5.0);
  warnUnknown(parameters);

  features_ = handle_.advertise<sensor_msgs::PointCloud2>(topics::kFeatures, 1);
  features_marker_ = handle_.advertise<visualization_msgs::Marker>(topics::kFeaturesMarker, 1);
  targets_ = handle_.advertise<softbody_msgs::Targets>(topics::kTargets, 1);
  status_ = handle_.advertise<softbody_msgs::TrackingStatus>(topics::kStatus, 1);
  timing_ = handle_.advertise<softbody_msgs::StageTiming>(topics::kTiming, 1);
  set_pose_ = private_handle.advertiseService("set_pose", &FeatureTrackerNode::onSetPose, this);

  volume_topology_subscriber_ =
      handle_.subscribe(topics::kVolumeTopology, 1, &FeatureTrackerNode::onVolumeTopology, this);
  surface_topology_subscriber_ =
      handle_.subscribe(topics::kSurfaceTopology, 1, &FeatureTrackerNode::onSurfaceTopology, this);
  volume_state_subscriber_ =
      handle_.subscribe(topics::kVolumeState, 1, &FeatureTrackerNode::onVolumeState, this);
  blade_subscriber_ = handle_.subscribe(topics::kToolBlade, kBladeQueue, &FeatureTrackerNode::onBlade, this);
  images_.emplace(handle_, [this](const RectifiedImages& images) { onFrame(images); });
  if (use_mask) {
    mask_input_ = std::make_unique<MaskInput>(
        handle_, mask_timeout_s,
        [this](const RectifiedImages& images, const cv::Mat1b& mask) { track(images, mask); });
  }

  diagnostics_.setHardwareID("none");
  diagnostics_.add("tracking",
                   [this](diagnostic_updater::DiagnosticStatusWrapper& status) { diagnose(status); });
  // Wall time, and not at update()'s own pace: both would wait for a bag that starts again.
  diagnostics_timer_ = handle_.createWallTimer(
      ros::WallDuration(1.0), [this](const ros::WallTimerEvent&) { diagnostics_.force_update(); });
}

void FeatureTrackerNode::onVolumeTopology(const softbody_msgs::TetTopology::ConstPtr& message) try {
  TetTopology topology = fromMessage(*message);
  // The topology is sent again every second; only a new one counts.
  const bool same = volume_topology_ && topology.revision == volume_topology_->revision &&
                    topology.rest_vertices == volume_topology_->rest_vertices &&
                    topology.tets == volume_topology_->tets;
  if (same) return;
  volume_topology_ = std::move(topology);
  adoptTopologies();
} catch (const std::exception& error) {
  ROS_ERROR_STREAM_THROTTLE(5.0, volume_topology_subscriber_.getTopic() << " is unusable: " << error.what());
}

void FeatureTrackerNode::onSurfaceTopology(const softbody_msgs::MeshTopology::ConstPtr& message) try {
  MeshTopology topology = fromMessage(*message);
  const bool same = surface_topology_ && topology.revision == surface_topology_->revision &&
                    topology.rest_vertices == surface_topology_->rest_vertices &&
                    topology.triangles == surface_topology_->triangles;
  if (same) return;
  surface_topology_ = std::move(topology);
  adoptTopologies();
} catch (const std::exception& error) {
  ROS_ERROR_STREAM_THROTTLE(5.0, surface_topology_subscriber_.getTopic() << " is unusable: " << error.what());
}

/// Both topologies of one revision; those of an edit when the body's first state of that revision has come,
/// unless the body has no state at all.
void FeatureTrackerNode::adoptTopologies() {
  if (!volume_topology_ || !surface_topology_) return;
  const std::uint32_t revision = volume_topology_->revision;
  if (surface_topology_->revision != revision) return;
  const bool edited = tracker_->ready() && revision > adopted_revision_;
  if (edited && newest_state_ && newest_state_->revision != revision) return;
  tracker_->setTopologies(*volume_topology_, *surface_topology_);
  adopted_revision_ = revision;
  volume_state_ = edited ? newest_state_ : nullptr;
}

void FeatureTrackerNode::onVolumeState(const softbody_msgs::MeshState::ConstPtr& message) try {
  newest_state_ = message;
  if (message->revision == adopted_revision_) {
    volume_state_ = message;
  } else {
    adoptTopologies();
  }
} catch (const std::exception& error) {
  ROS_ERROR_STREAM_THROTTLE(
      5.0, "the topologies of revision " << message->revision << " are unusable: " << error.what());
}

void FeatureTrackerNode::onBlade(const geometry_msgs::PolygonStamped::ConstPtr& message) {
  blades_.add(
      {toNanoseconds(message->header.stamp), message->header.frame_id, fromMessage(message->polygon)});
}

/// Without patience: waiting for tf here would hold up all that comes, blade by blade.
void FeatureTrackerNode::placeBlade(const ros::Time& stamp) {
  std::string reason;
  const auto place = [&](const ReportedBlade& blade) -> std::optional<Eigen::Isometry3d> {
    std_msgs::Header header;
    header.stamp = toTime(blade.stamp);
    header.frame_id = blade.frame_id;
    try {
      return fixedPose(header, 0.0);
    } catch (const tf2::TransformException& error) {
      if (reason.empty()) reason = error.what();  // of the oldest
      return std::nullopt;
    }
  };
  const BladeQueue::Unused unused = blades_.show(toNanoseconds(stamp), place, &tool_mask_);
  if (unused.lost > 0) ROS_WARN_STREAM_THROTTLE(5.0, "the blade's place is not known: " << reason);
  if (unused.ahead > 0)
    ROS_WARN_STREAM_THROTTLE(
        5.0, fmt::format("the blade does not cover the body: its stamp is {:.1f} s ahead of the "
                         "frame's; both must be of one clock",
                         1e-9 * static_cast<double>(unused.ahead)));
}

void FeatureTrackerNode::skip(const std_msgs::Header& header, const std::string& why) {
  last_status_ = skippedFrame(last_status_, header.frame_id, output_frame_->name(), why);
  ROS_WARN_STREAM_THROTTLE(5.0, last_status_.reason);
  publishStatus(header);
}

std::optional<MeshState> FeatureTrackerNode::volume() const try {
  if (!volume_state_) return std::nullopt;
  MeshState state = fromMessage(*volume_state_);
  if (volume_topology_ && volume_topology_->revision == state.revision &&
      volume_topology_->rest_vertices.rows() != state.vertices.rows()) {
    throw std::invalid_argument(std::to_string(state.vertices.rows()) + " vertices, but the topology has " +
                                std::to_string(volume_topology_->rest_vertices.rows()));
  }
  return state;
} catch (const std::invalid_argument& error) {
  ROS_ERROR_STREAM_THROTTLE(5.0, volume_state_subscriber_.getTopic() << " is unusable: " << error.what());
  return std::nullopt;
}

/// Where a header's frame, empty: the camera's, is in the fixed one: the output frame, or without one the
/// camera's.
Eigen::Isometry3d FeatureTrackerNode::fixedPose(const std_msgs::Header& header, double patience_s) const {
  const std::string& fixed = output_frame_->name().empty() ? camera_frame_ : output_frame_->name();
  const std::string& frame = header.frame_id.empty() ? camera_frame_ : header.frame_id;
  if (frame == fixed) return Eigen::Isometry3d::Identity();
  return output_frame_->lookUp(fixed, frame, header.stamp, patience_s);
}

bool FeatureTrackerNode::onSetPose(softbody_msgs::SetPose::Request& request,
                                   softbody_msgs::SetPose::Response& response) try {
  if (camera_frame_.empty()) throw std::logic_error("no frame of the camera has come yet");
  const Eigen::Isometry3d T_frame_body = fromMessage(request.pose.pose);
  tracker_->restart(fixedPose(request.pose.header, kSetPosePatience_s) * T_frame_body);
  response.success = 1;
  ROS_INFO("tracking starts anew near the pose set by hand");
  return true;
} catch (const std::exception& error) {
  response.success = 0;
  response.message = std::string("the pose is not taken: ") + error.what();
  ROS_WARN_STREAM(response.message);
  return true;
}

void FeatureTrackerNode::onFrame(const RectifiedImages& images) {
  if (mask_input_) return mask_input_->add(images);
  track(images, cv::Mat1b());
}

/// @param mask empty: none.
void FeatureTrackerNode::track(const RectifiedImages& images, const cv::Mat1b& mask) try {
  const std_msgs::Header& header = images.color->header;
  camera_frame_ = header.frame_id;
  // A bag that loops: what was said of later times is void.
  if (header.stamp < last_stamp_) volume_state_.reset(), newest_state_.reset(), blades_.clear();
  last_stamp_ = header.stamp;
  last_arrival_ = ros::Time::now();
  Eigen::Isometry3d T_output_camera;
  try {
    T_output_camera = output_frame_->poseOf(header);
  } catch (const tf2::TransformException& error) {
    return skip(header, error.what());
  }

  const auto color_image = cv_bridge::toCvShare(images.color, sensor_msgs::image_encodings::BGR8);
  const auto depth_image = cv_bridge::toCvShare(images.depth, sensor_msgs::image_encodings::TYPE_32FC1);
  RgbdFrame frame{toNanoseconds(header.stamp), pinholeFromMessage(*images.info), color_image->image,
                  mask.empty() ? cv::Mat1f(depth_image->image) : masked(depth_image->image, mask),
                  T_output_camera};
  placeBlade(header.stamp);
  frame = tool_mask_.without(frame);
  const std::optional<MeshState> state = volume();
  StageTimer timer;
  const TrackingResult result = tracker_->track(frame, state ? &*state : nullptr, &timer);
  last_status_ = result.status;
  publishStatus(header);
  publish(header, T_output_camera, result);
  softbody_msgs::StageTiming timing = timingMessage("feature_tracker", timer.take());
  timing.header = header;
  timing_.publish(timing);
} catch (const std::exception& error) {
  ROS_ERROR_STREAM_THROTTLE(5.0,
                            "frame " << images.color->header.stamp << " cannot be tracked: " << error.what());
}

void FeatureTrackerNode::publishStatus(const std_msgs::Header& header) {
  const auto status = boost::make_shared<softbody_msgs::TrackingStatus>(toMessage(last_status_));
  status->header = header;
  status_.publish(status);
}

void FeatureTrackerNode::publish(const std_msgs::Header& camera_header,
                                 const Eigen::Isometry3d& T_output_camera, const TrackingResult& result) {
  if (!result.has_targets) {
    ROS_WARN_STREAM_THROTTLE(5.0, "not tracking: " << result.status.reason);
    return;
  }
  if (features_.getNumSubscribers() != 0) {
    const auto cloud = boost::make_shared<sensor_msgs::PointCloud2>(makeFeatureCloud(result.features));
    cloud->header = camera_header;
    features_.publish(cloud);
  }
  if (features_marker_.getNumSubscribers() != 0) {
    const auto marker = boost::make_shared<visualization_msgs::Marker>(makeFeatureMarker(result.features));
    marker->header = camera_header;
    features_marker_.publish(marker);
  }
  const auto targets = boost::make_shared<softbody_msgs::Targets>(toMessage(result.targets));
  targets->header = camera_header;
  if (!output_frame_->name().empty()) targets->header.frame_id = output_frame_->name();
  targets_.publish(targets);

  geometry_msgs::TransformStamped body =
      tf2::eigenToTransform(T_output_camera.inverse() * result.targets.body_pose);
  body.header = camera_header;
  body.child_frame_id = body_frame_;
  tf_broadcaster_.sendTransform(body);
}

void FeatureTrackerNode::diagnose(diagnostic_updater::DiagnosticStatusWrapper& status) const {
  if (isSilent(last_arrival_)) {
    status.summary(diagnostic_msgs::DiagnosticStatus::WARN, silenceInWords());
    return;
  }
  const bool good = last_status_.state == TrackingState::kTracking;
  const bool lost = last_status_.state == TrackingState::kLost;
  status.summary(
      good ? diagnostic_msgs::DiagnosticStatus::OK
           : (lost ? diagnostic_msgs::DiagnosticStatus::ERROR : diagnostic_msgs::DiagnosticStatus::WARN),
      std::string(nameOf(last_status_.state)) +
          (last_status_.reason.empty() ? "" : ": " + last_status_.reason));
  status.add("features tracked", last_status_.features_tracked);
  status.add("features bound", last_status_.features_total);
  status.add("inlier ratio", last_status_.inlier_ratio);
  status.add("residual rms [m]", last_status_.residual_rms);
}

}  // namespace softbody
