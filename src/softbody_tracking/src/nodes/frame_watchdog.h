#pragma once

#include <ros/time.h>

#include <cmath>
#include <sstream>
#include <string>

#include "softbody_common/ros/time.h"

namespace softbody {

/// Notices that camera_ingest sends no frames. It uses the arrival times in ROS time, not the stamps: a
/// paused bag is not a fault, and the camera's clock may differ from ours.
class FrameWatchdog {
 public:
  void frameArrived() { last_arrival_ = ros::Time::now(); }

  /// True before the first frame, after a gap of more than kTimeout_s, and after a bag has started again.
  bool isExpired() const {
    return last_arrival_.isZero() || std::abs(secondsBetween(last_arrival_, ros::Time::now())) > kTimeout_s;
  }

  static std::string message() {
    std::ostringstream message;
    message << "no frame from camera_ingest for over " << kTimeout_s << " s";
    return message.str();
  }

 private:
  static constexpr double kTimeout_s = 2.0;  // [s] far longer than any camera's frame period

  ros::Time last_arrival_;
};

}  // namespace softbody
