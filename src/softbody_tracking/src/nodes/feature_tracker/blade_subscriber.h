#pragma once

#include <geometry_msgs/PolygonStamped.h>
#include <ros/ros.h>
#include <std_msgs/Header.h>

#include <Eigen/Geometry>
#include <functional>

#include "blade/blade_buffer.h"
#include "softbody_common/ros/stamp_gate.h"
#include "softbody_tracking/tool/tool_mask.h"

namespace softbody {

/// Receives the blade from tool_tracker and masks it in frames. Warns if its pose is unknown or its clock
/// differs.
class BladeSubscriber {
 public:
  /// T_fixed_frame of a header's frame, without waiting for tf. @throw tf2::TransformException if unknown.
  using PoseLookup = std::function<Eigen::Isometry3d(const std_msgs::Header& header)>;

  BladeSubscriber(ros::NodeHandle handle, PoseLookup look_up);

  /// The frame without depth on the blade, see ToolMask.
  RgbdFrame withoutBlade(const RgbdFrame& frame);

  /// Forgets all blades, for when time has jumped back.
  void clear() { blades_.clear(); }

 private:
  void onBlade(const geometry_msgs::PolygonStamped::ConstPtr& message);

  PoseLookup look_up_;
  StampGate stamps_;
  BladeBuffer blades_;
  ToolMask mask_;
  ros::Subscriber subscriber_;
};

}  // namespace softbody
