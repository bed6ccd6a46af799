#include "nodes/feature_tracker/feature_tracker_node.h"

#include <stdexcept>
#include <utility>

#include "softbody_common/images/object_texture.h"
#include "softbody_common/protocol/topics.h"
#include "softbody_common/protocol/tracking_state.h"
#include "softbody_common/ros/conversions.h"
#include "softbody_common/ros/frame_name.h"
#include "softbody_common/ros/ros_parameters.h"

namespace softbody {
namespace {

// [s] between two statuses while no image comes: often enough for a person and for a robot's monitor.
constexpr double kStatusPeriod_s = 1.0;
// [s] the nodes of a launch file start within this time, or are started again.
constexpr double kConnectionTimeout_s = 3.0;
constexpr double kSetPoseTimeout_s = 0.5;  // [s] to wait for tf; a person waits for the answer

/// The body is tracked without its picture, too.
cv::Mat3b loadPicture(const FeatureTrackerOptions& options) {
  if (options.object.empty()) return {};
  try {
    return readObjectTexture(options.object, fileScope(options.allow_outside));
  } catch (const std::invalid_argument& error) {
    ROS_WARN_STREAM("the body is searched for without its picture: " << error.what());
    return {};
  }
}

diagnostic_msgs::DiagnosticStatus::_level_type diagnosticLevel(TrackingState state) {
  using diagnostic_msgs::DiagnosticStatus;
  if (state == TrackingState::kTracking) return DiagnosticStatus::OK;
  return state == TrackingState::kLost ? DiagnosticStatus::ERROR : DiagnosticStatus::WARN;
}

}  // namespace

FeatureTrackerNode::FeatureTrackerNode(const ros::NodeHandle& handle, const ros::NodeHandle& private_handle)
    : FeatureTrackerNode(handle, private_handle,
                         readOptions(private_handle, featureTrackerNodeParameters())) {}

FeatureTrackerNode::FeatureTrackerNode(const ros::NodeHandle& handle, ros::NodeHandle private_handle,
                                       const FeatureTrackerOptions& options)
    : options_(options),
      output_frame_(options.output_frame),
      tracker_(options.tracker),
      publisher_(handle,
                 output_frame_.claim(ownFrame(options.body_frame, "body_frame", private_handle, "softbody"))),
      stamps_(handle.resolveName(topics::kRgbRect)),
      body_(handle, &tracker_, [this, private_handle] { readPicture(private_handle); }),
      blade_(handle, [this](const auto& header) { return output_frame_.poseOf(header, camera_frame_, 0.0); }),
      known_(subscribeToKnown(
          handle, options.known_surfaces,
          [this](const auto& header) { return output_frame_.poseOf(header, camera_frame_, 0.0); })),
      robot_(makeRobotLinks(handle, options.robot, &output_frame_)),
      set_pose_(private_handle.advertiseService("set_pose", &FeatureTrackerNode::onSetPose, this)),
      find_again_(private_handle.advertiseService("find_again", &FeatureTrackerNode::onFindAgain, this)),
      mask_synchronizer_(makeMaskSynchronizer(
          handle, options.mask, [this](const auto& frame, const auto& mask) { track(frame, mask); })),
      images_(handle, [this](const RectifiedImages& images) { onFrame(images); }),
      diagnostics_(handle, private_handle, "tracking", [this](auto& status) { diagnose(status); }),
      live_parameters_(private_handle, featureTrackerNodeParameters(), &options_,
                       [this](const FeatureTrackerOptions& next) { tracker_.setConfig(next.tracker); }) {
  reportSilence();
  // Wall time: without /clock a simulated timer never fires.
  silence_timer_ = ros::NodeHandle(handle).createWallTimer(
      ros::WallDuration(kStatusPeriod_s), [this](const ros::WallTimerEvent&) { reportSilence(); });
}

/// The simulator changes the parameter ~object before it publishes another object.
void FeatureTrackerNode::readPicture(const ros::NodeHandle& private_handle) {
  private_handle.getParam("object", options_.object);
  tracker_.setPicture(loadPicture(options_));
}

bool FeatureTrackerNode::onSetPose(softbody_msgs::SetPose::Request& request,
                                   softbody_msgs::SetPose::Response& response) try {
  if (camera_frame_.empty()) throw std::logic_error("no camera frame has arrived yet");
  const Eigen::Isometry3d T_frame_body = fromMessage(request.pose.pose);
  tracker_.restart(output_frame_.poseOf(request.pose.header, camera_frame_, kSetPoseTimeout_s) *
                   T_frame_body);
  response.success = 1;
  ROS_INFO("tracking restarts near the given pose");
  return true;
} catch (const std::exception& error) {
  response.success = 0;
  response.message = std::string("the pose is not accepted: ") + error.what();
  ROS_WARN_STREAM(response.message);
  return true;
}

/// Only the pose is searched for again: the topologies, and so the cuts, stay.
bool FeatureTrackerNode::onFindAgain(std_srvs::Trigger::Request& /*request*/,
                                     std_srvs::Trigger::Response& response) {
  response.success = tracker_.ready() ? 1 : 0;
  if (!tracker_.ready()) {
    response.message = "the search cannot start: the topologies of simulator and surface have not come yet";
    ROS_WARN_STREAM(response.message);
    return true;
  }
  tracker_.reset();
  ROS_INFO("the body is searched for again, as at the start");
  return true;
}

void FeatureTrackerNode::onFrame(const RectifiedImages& images) try {
  RgbdFrame frame =
      frameFromImages(images);  // before its stamp is judged: what is refused must not move time
  const StampVerdict verdict = stamps_.judge(images.color->header.stamp);
  if (!verdict.accepted()) return;
  if (verdict.kind == StampVerdict::kJumpedBack) forgetPass();
  watchdog_.frameArrived();
  frame.pass = stamps_.pass();
  const ReceivedFrame received{images, frame};
  if (mask_synchronizer_) return mask_synchronizer_->addFrame(received);
  track(received, cv::Mat1b());
} catch (const std::exception& error) {
  ROS_ERROR_STREAM_THROTTLE(5.0, "frame " << images.color->header.stamp << " is not used: " << error.what());
}

/// @param mask empty: all pixels count.
void FeatureTrackerNode::track(const ReceivedFrame& received, const cv::Mat1b& mask) try {
  const std_msgs::Header& header = received.images.color->header;
  camera_frame_ = header.frame_id;
  const std::optional<Eigen::Isometry3d> T_fixed_camera = cameraPose(header);
  if (!T_fixed_camera) return;
  RgbdFrame frame = received.frame;
  frame.T_fixed_camera = *T_fixed_camera;
  if (!mask.empty()) frame = masked(frame, mask);
  frame = withKnown(blade_.withoutBlade(frame), header);
  const MeshState* state = body_.state(output_frame_.fixedHeader(header).frame_id);
  StageTimer timer;
  // The simulator waits for the targets; nobody waits for the rest.
  const TrackingResult result = tracker_.track(frame, state, &timer, [&](const TargetSet& targets) {
    publisher_.publishTargets(output_frame_.fixedHeader(header), targets);
    publisher_.publishBodyPose(header, frame.T_fixed_camera.inverse() * targets.body_pose);
  });
  watchdog_.frameArrived();  // a search may take seconds
  publish(header, frame.depth.size(), result);
  publisher_.publishTiming(header, timer.take());
} catch (const std::exception& error) {
  const std_msgs::Header& header = received.images.color->header;
  report(header, skippedFrame(last_status_, error.what()));
  ROS_ERROR_STREAM_THROTTLE(5.0, "frame " << header.stamp << " cannot be tracked: " << error.what());
}

/// Marks the pixels that show other known surfaces.
RgbdFrame FeatureTrackerNode::withKnown(RgbdFrame frame, const std_msgs::Header& header) {
  std::vector<KnownSurface> surfaces;
  if (robot_) surfaces = robot_->at(frame, header);
  for (const auto& subscriber : known_)
    if (std::optional<KnownSurface> surface = subscriber->at(frame)) surfaces.push_back(std::move(*surface));
  return withKnownSurfaces(std::move(frame), surfaces);
}

/// A bag has started again: states, blades and frames from the end of it are invalid.
void FeatureTrackerNode::forgetPass() {
  body_.clearStates();
  blade_.clear();
  for (const auto& subscriber : known_) subscriber->clearStates();
  if (mask_synchronizer_) mask_synchronizer_->forgetFrames();
}

/// If tf does not know the camera's pose, the frame is skipped and the status says why.
std::optional<Eigen::Isometry3d> FeatureTrackerNode::cameraPose(const std_msgs::Header& header) try {
  return output_frame_.cameraPose(header);
} catch (const tf2::TransformException& error) {
  report(header, skippedFrame(last_status_, header.frame_id, output_frame_.name(), error.what()));
  ROS_WARN_STREAM_THROTTLE(5.0, last_status_.reason);
  return std::nullopt;
}

/// Publishes a status, and logs what the state has become.
void FeatureTrackerNode::report(const std_msgs::Header& header, const TrackingStatus& status) {
  last_header_ = header;
  last_status_ = status;
  publisher_.publishStatus(header, status);
  const auto line = announcer_.announce(status, ros::SteadyTime::now().toSec());
  if (line && line->warning)
    ROS_WARN_STREAM(line->sentence);
  else if (line)
    ROS_INFO_STREAM(line->sentence);
}

/// Without images nothing else says that the last state has become invalid.
void FeatureTrackerNode::reportSilence() {
  if (!watchdog_.isExpired()) return;
  report(last_header_, withoutImages(last_status_, watchdog_.silence()));
  const ros::SteadyTime now = ros::SteadyTime::now();
  if (images_.hasPublisher())
    last_publisher_ = now;
  else if ((now - last_publisher_).toSec() > kConnectionTimeout_s)
    log_.warn("no publisher", "feature_tracker waits for images: nobody publishes " + images_.topic() +
                                  ". camera_ingest is not running, and its last message says why");
}

/// All but the targets and the pose.
void FeatureTrackerNode::publish(const std_msgs::Header& header, const cv::Size& image,
                                 const TrackingResult& result) {
  report(header, result.status);
  if (!result.has_targets) {
    ROS_WARN_STREAM_THROTTLE(5.0, "not tracking: " << result.status.reason);
    return;
  }
  publisher_.publishFeatures(header, result.features);
  publisher_.publishLabels(header, result, image);
}

void FeatureTrackerNode::diagnose(NodeDiagnostics::Status& status) const {
  if (watchdog_.isExpired()) {
    status.summary(diagnostic_msgs::DiagnosticStatus::WARN, watchdog_.message());
    return;
  }
  const std::string reason = last_status_.reason.empty() ? "" : ": " + last_status_.reason;
  status.summary(diagnosticLevel(last_status_.state), nameOf(last_status_.state) + reason);
  status.add("features tracked", last_status_.features_tracked);
  status.add("features bound", last_status_.features_total);
  status.add("inlier ratio", last_status_.inlier_ratio);
  status.add("residual rms [m]", last_status_.residual_rms);
  status.add("frames dropped to keep up", images_.dropped());
}

}  // namespace softbody
