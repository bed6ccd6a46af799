#pragma once

#include <ros/ros.h>
#include <std_msgs/Header.h>

#include "softbody_common/stage_timer.h"
#include "softbody_tracking/rgbd_frame.h"

namespace softbody {

/// The topics of camera_ingest: rectified colour and depth, their camera_info, points and stage times.
class CameraIngestOutputs {
 public:
  /// @param voxel_size_m of the points; 0: organised, one point a pixel.
  CameraIngestOutputs(ros::NodeHandle handle, double voxel_size_m);

  bool hasSubscriber() const;

  /// Publishes what has a subscriber, and the timer's rows with it.
  void publish(const RgbdFrame& frame, const std_msgs::Header& header, StageTimer* timer) const;

 private:
  void publishPoints(const RgbdFrame& frame, const std_msgs::Header& header) const;

  double voxel_size_m_;
  ros::Publisher color_, info_, depth_, points_, timing_;
};

}  // namespace softbody
