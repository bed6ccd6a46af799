#pragma once

#include <diagnostic_updater/diagnostic_updater.h>
#include <ros/ros.h>
#include <tf2_ros/transform_broadcaster.h>

#include <memory>
#include <optional>
#include <string>

#include "nodes/output_frame.h"
#include "nodes/rectified_input.h"
#include "softbody_tracking/ros/blade_trail.h"
#include "softbody_tracking/tool/tool_tracker.h"
#include "softbody_tracking/tool/tool_watch.h"

namespace softbody {

/// Rectified images in; the tool's pose with covariance, its blade and its tf out.
class ToolTrackerNode {
 public:
  /// @throw std::invalid_argument for a bad parameter or tool YAML.
  ToolTrackerNode(const ros::NodeHandle& handle, const ros::NodeHandle& private_handle);

 private:
  void onFrame(const RectifiedImages& images);
  void place(const std_msgs::Header& header, RgbdFrame* frame);
  void publish(const std_msgs::Header& header, const RgbdFrame& frame);
  void publishBlade(const std_msgs::Header& header, const RgbdFrame& frame);
  void diagnose(diagnostic_updater::DiagnosticStatusWrapper& status) const;

  ros::NodeHandle handle_;
  std::string tool_frame_;
  std::unique_ptr<OutputFrame> output_frame_;
  std::unique_ptr<ToolTracker> tracker_;
  ToolWatch watch_;
  std::optional<ToolObservation> last_;  ///< of the last frame
  ros::Time last_arrival_;               ///< when it came
  std::string unusable_;                 ///< why the last frame could not be used; empty: it could
  std::string not_placed_;               ///< why tf does not place the last frame's camera; empty: it does

  tf2_ros::TransformBroadcaster tf_broadcaster_;
  std::optional<BladeTrail> trail_;  ///< of a tool with a blade
  ros::Publisher pose_, blade_, marker_, timing_;
  std::optional<RectifiedInput> images_;
  diagnostic_updater::Updater diagnostics_;
  ros::WallTimer diagnostics_timer_;
};

}  // namespace softbody
