#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "nodes/camera_ingest_node.h"
#include "softbody_common/ros/conversions.h"

/// What the node says about itself: why there are no frames, rates and latency.
namespace softbody {
namespace {

constexpr double kDiagnosisPeriod_s = 1.0, kRemarkPeriod_s = 60.0;
constexpr double kLongestLatency_s = 2.0, kLongestLead_s = 0.1;  // beyond, clocks differ
// A camera may be so many times as long in starting as it may be silent.
constexpr double kStartTimeouts = 5.0;

}  // namespace

double CameraIngestNode::secondsWithoutFrame() const {
  // Before the first frame the clock itself may be missing; later a paused bag is no silence.
  if (last_frame_.isZero()) return (ros::WallTime::now() - start_).toSec();
  return (ros::Time::now() - last_frame_).toSec();
}

bool CameraIngestNode::isStarting() const {
  if (!last_frame_.isZero()) return false;
  // Images that come and make no frame are a fault, once there was time for one.
  if (!both_came_.isZero()) return (ros::WallTime::now() - both_came_).toSec() < config_.silence_timeout_s;
  return secondsWithoutFrame() < kStartTimeouts * config_.silence_timeout_s;
}

std::string CameraIngestNode::silence() const {
  return fmt::format("{} {:.0f} s: {}", isStarting() ? "waiting for the first frame for" : "no frame for",
                     secondsWithoutFrame(), complaint());
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
                              StreamTopic{depth_subscriber_.getTopic(), publishers(depth_subscriber_)}},
                             toNanoseconds(ros::Time::now()));
}

/// What is odd about frames that come.
std::vector<CameraIngestNode::Remark> CameraIngestNode::remarks() const {
  std::vector<Remark> remarks;
  if (color_frame_.empty())
    remarks.push_back(
        {"no frame", fmt::format("{} has no frame_id, so no result has one: set the driver's optical frame",
                                 color_subscriber_.getTopic())});
  if (depth_frame_ != color_frame_)
    remarks.push_back(
        {"two frames",
         fmt::format("{} is in frame '{}', {} in '{}'; if it is registered to colour, it should say "
                     "colour's frame",
                     depth_subscriber_.getTopic(), depth_frame_, color_subscriber_.getTopic(),
                     color_frame_)});
  // A simulated clock is made of the stamps, and lags behind them.
  if (!ros::Time::isSimTime() && (latency_s_ > kLongestLatency_s || latency_s_ < -kLongestLead_s))
    remarks.push_back(
        {"clock",
         fmt::format(
             "stamps are {:.1f} s {} this machine's clock, by which tf and timers go: synchronise the "
             "camera's clock; a bag needs use_sim_time and --clock",
             std::abs(latency_s_), latency_s_ > 0.0 ? "behind" : "ahead of")});
  return remarks;
}

void CameraIngestNode::watch() {
  // A bag that starts again: the silence is counted from there.
  if (ros::Time::now() < last_frame_) last_frame_ = ros::Time::now();
  if (both_came_.isZero() && monitor_->hasCome(Stream::kColor) && monitor_->hasCome(Stream::kDepth))
    both_came_ = ros::WallTime::now();
  if (secondsWithoutFrame() > config_.silence_timeout_s) {
    if (isStarting())
      throttle_.info("start", silence());
    else
      throttle_.warn("silence", silence());
  }
  if ((ros::WallTime::now() - last_diagnosis_).toSec() >= kDiagnosisPeriod_s) diagnostics_.force_update();
}

void CameraIngestNode::diagnose(diagnostic_updater::DiagnosticStatusWrapper& status) {
  using diagnostic_msgs::DiagnosticStatus;
  const double period = (ros::WallTime::now() - last_diagnosis_).toSec();
  const double rate = frames_ / std::max(period, 1e-3);
  std::vector<std::string> odd;
  for (const Remark& remark : frames_ > 0 ? remarks() : std::vector<Remark>()) {
    throttle_.warn(remark.about, remark.sentence, kRemarkPeriod_s);
    odd.push_back(remark.sentence);
  }
  if (secondsWithoutFrame() > config_.silence_timeout_s) {
    status.summary(isStarting() ? DiagnosticStatus::WARN : DiagnosticStatus::ERROR, silence());
  } else if (refused_ > 0) {
    status.summary(DiagnosticStatus::WARN,
                   fmt::format("{} frames could not be used: {}", refused_, complaint()));
  } else if (!odd.empty()) {
    status.summary(DiagnosticStatus::WARN, fmt::format("{}", fmt::join(odd, "; ")));
  } else {
    status.summary(DiagnosticStatus::OK, fmt::format("{:.1f} frames a second", rate));
  }
  status.add("frames per second", fmt::format("{:.1f}", rate));
  status.add("frames refused", refused_);
  status.add("latency [ms]", fmt::format("{:.1f}", std::max(0.0, latency_s_) * 1e3));
  status.add("colour", color_subscriber_.getTopic());
  status.add("depth", depth_subscriber_.getTopic());
  frames_ = refused_ = 0;
  last_diagnosis_ = ros::WallTime::now();
}

}  // namespace softbody
