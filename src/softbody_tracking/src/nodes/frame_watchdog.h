#pragma once

#include <fmt/format.h>
#include <ros/time.h>

#include <optional>
#include <string>

#include "softbody_common/ros/time.h"

namespace softbody {

/// Notices that camera_ingest sends no frames. It uses the arrival times in ROS time, not the stamps: a
/// paused bag is not a fault, and the camera's clock may differ from ours. Only while /clock is silent, it
/// uses the machine's clock.
class FrameWatchdog {
 public:
  /// @param timeout_s longest time without a frame.
  explicit FrameWatchdog(double timeout_s = 2.0) : timeout_s_(timeout_s) {}

  /// Call it when a frame arrives, and again when it has been processed.
  void frameArrived() {
    last_ = ros::Time::now();
    last_on_machine_ = ros::SteadyTime::now();
  }

  /// Time without a frame [s]; empty before the first one.
  std::optional<double> silence() const {
    if (last_on_machine_.isZero()) return std::nullopt;
    const ros::Time now = ros::Time::now();
    if (now.isZero()) return (ros::SteadyTime::now() - last_on_machine_).toSec();
    // The clock starts, or a recording starts again: the silence begins there.
    if (last_.isZero() || now < last_) last_ = now;
    return secondsBetween(last_, now);
  }

  /// True before the first frame, and after a silence that is longer than the timeout.
  bool isExpired() const { return silence().value_or(timeout_s_ + 1.0) > timeout_s_; }

  std::string message() const { return fmt::format("no frame from camera_ingest for over {} s", timeout_s_); }

 private:
  double timeout_s_;
  mutable ros::Time last_;
  ros::SteadyTime last_on_machine_;
};

}  // namespace softbody
