#include <fmt/format.h>

#include "nodes/camera_ingest_node.h"

/// What the node says about itself: why there are no frames, rates and latency.
namespace softbody {
namespace {

constexpr double kDiagnosisPeriod_s = 1.0, kWarningPeriod_s = 5.0;

}  // namespace

double CameraIngestNode::secondsWithoutFrame() const {
  // Before the first frame the clock itself may be missing; later a paused bag is no silence.
  if (last_frame_.isZero()) return (ros::WallTime::now() - start_).toSec();
  return (ros::Time::now() - last_frame_).toSec();
}

std::string CameraIngestNode::complaint() const {
  if (ros::Time::isSimTime() && ros::Time::now().isZero()) {
    return "use_sim_time is set, but /clock is silent (rosbag play --clock?)";
  }
  const auto publishers = [](const auto& subscriber) {
    return static_cast<int>(subscriber.getNumPublishers());
  };
  return monitor_->complaint({StreamTopic{color_subscriber_.getTopic(), publishers(color_subscriber_)},
                              StreamTopic{info_subscriber_.getTopic(), publishers(info_subscriber_)},
                              StreamTopic{depth_subscriber_.getTopic(), publishers(depth_subscriber_)}});
}

void CameraIngestNode::warn(const std::string& sentence) {
  // ROS_WARN_THROTTLE counts ROS time, which may stand still.
  const ros::WallTime now = ros::WallTime::now();
  if (!last_warning_.isZero() && (now - last_warning_).toSec() < kWarningPeriod_s) return;
  last_warning_ = now;
  ROS_WARN_STREAM(sentence);
}

void CameraIngestNode::watch() {
  // A bag that starts again: the silence is counted from there.
  if (ros::Time::now() < last_frame_) last_frame_ = ros::Time::now();
  const double silence = secondsWithoutFrame();
  if (silence > config_.silence_timeout_s)
    warn(fmt::format("no frame for {:.0f} s: {}", silence, complaint()));
  if ((ros::WallTime::now() - last_diagnosis_).toSec() >= kDiagnosisPeriod_s) diagnostics_.force_update();
}

void CameraIngestNode::diagnose(diagnostic_updater::DiagnosticStatusWrapper& status) {
  using diagnostic_msgs::DiagnosticStatus;
  const double silence = secondsWithoutFrame();
  const double period = (ros::WallTime::now() - last_diagnosis_).toSec();
  const double rate = frames_ / std::max(period, 1e-3);
  if (silence > config_.silence_timeout_s) {
    status.summary(DiagnosticStatus::ERROR, fmt::format("no frame for {:.0f} s: {}", silence, complaint()));
  } else if (refused_ > 0) {
    status.summary(DiagnosticStatus::WARN,
                   fmt::format("{} frames could not be used: {}", refused_, complaint()));
  } else {
    status.summary(DiagnosticStatus::OK, fmt::format("{:.1f} frames a second", rate));
  }
  status.add("frames per second", fmt::format("{:.1f}", rate));
  status.add("frames refused", refused_);
  status.add("latency [ms]", fmt::format("{:.1f}", latency_s_ * 1e3));
  status.add("colour", color_subscriber_.getTopic());
  status.add("depth", depth_subscriber_.getTopic());
  frames_ = refused_ = 0;
  last_diagnosis_ = ros::WallTime::now();
}

}  // namespace softbody
