#include "nodes/tool_tracker/tool_tracker_node.h"

#include <cv_bridge/cv_bridge.h>
#include <geometry_msgs/PolygonStamped.h>
#include <geometry_msgs/PoseWithCovarianceStamped.h>
#include <sensor_msgs/image_encodings.h>
#include <softbody_msgs/StageTiming.h>
#include <tf2_eigen/tf2_eigen.h>

#include <boost/make_shared.hpp>
#include <cmath>

#include "nodes/silence.h"
#include "softbody_common/ros/conversions.h"
#include "softbody_common/ros/ros_parameters.h"
#include "softbody_common/topics.h"
#include "softbody_tracking/ros/tool_messages.h"

namespace softbody {

ToolTrackerNode::ToolTrackerNode(const ros::NodeHandle& handle, const ros::NodeHandle& private_handle)
    : handle_(handle), diagnostics_(handle, private_handle, private_handle.getNamespace()) {
  Parameters parameters = readParameters(private_handle);
  tool_frame_ = parameters.text("tool_frame", "tool");
  output_frame_ = std::make_unique<OutputFrame>(parameters);
  const ToolDescription tool = loadToolDescription(parameters.requiredText("tool"));
  for (const std::string& warning : tool.warnings) ROS_WARN_STREAM(warning);
  tracker_ = std::make_unique<ToolTracker>(tool, readToolTrackerConfig(parameters));
  warnUnknown(parameters);

  pose_ = handle_.advertise<geometry_msgs::PoseWithCovarianceStamped>(topics::kToolPose, 1);
  if (tool.blade.rows() > 0) {
    blade_ = handle_.advertise<geometry_msgs::PolygonStamped>(topics::kToolBlade, 1);
    marker_ = handle_.advertise<visualization_msgs::MarkerArray>(topics::kToolMarker, 1);
    trail_.emplace(tool.blade);
  }
  timing_ = handle_.advertise<softbody_msgs::StageTiming>(topics::kTiming, 1);

  images_.emplace(handle_, [this](const RectifiedImages& images) { onFrame(images); });

  diagnostics_.setHardwareID("none");
  diagnostics_.add("tool", [this](diagnostic_updater::DiagnosticStatusWrapper& status) { diagnose(status); });
  // Wall time, and not at update()'s own pace: both would wait for a bag that starts again.
  diagnostics_timer_ = handle_.createWallTimer(
      ros::WallDuration(1.0), [this](const ros::WallTimerEvent&) { diagnostics_.force_update(); });
}

void ToolTrackerNode::onFrame(const RectifiedImages& images) try {
  last_arrival_ = ros::Time::now();
  const std_msgs::Header& header = images.color->header;
  const auto color_image = cv_bridge::toCvShare(images.color, sensor_msgs::image_encodings::BGR8);
  const auto depth_image = cv_bridge::toCvShare(images.depth, sensor_msgs::image_encodings::TYPE_32FC1);
  RgbdFrame frame{toNanoseconds(header.stamp), pinholeFromMessage(*images.info), color_image->image,
                  depth_image->image};
  place(header, &frame);
  StageTimer timer;
  last_ = tracker_->track(frame, &timer);
  unusable_.clear();
  const auto missing = watch_.heed(frame.stamp, last_, tracker_->reason());
  if (missing) ROS_WARN_STREAM(*missing);
  if (last_) publish(header, frame);
  softbody_msgs::StageTiming timing = timingMessage("tool_tracker", timer.take());
  timing.header = header;
  timing_.publish(timing);
} catch (const std::exception& error) {
  unusable_ = error.what();
  ROS_ERROR_STREAM_THROTTLE(
      5.0, "the tool cannot be looked for in frame " << images.color->header.stamp << ": " << error.what());
}

void ToolTrackerNode::place(const std_msgs::Header& header, RgbdFrame* frame) try {
  frame->T_fixed_camera = output_frame_->poseOf(header);
  not_placed_.clear();
} catch (const tf2::TransformException& error) {
  frame->placed = false;
  not_placed_ = "tf does not say where " + header.frame_id + " is in output_frame " + output_frame_->name() +
                ": " + error.what();
  ROS_WARN_STREAM_THROTTLE(5.0, "the tool is not predicted and has no trail: " << not_placed_);
}

void ToolTrackerNode::publish(const std_msgs::Header& header, const RgbdFrame& frame) {
  const auto pose = boost::make_shared<geometry_msgs::PoseWithCovarianceStamped>();
  pose->header = header;
  pose->pose = toMessage(*last_);
  pose_.publish(pose);
  // What is only predicted must not cut.
  if (trail_ && !last_->bridged) publishBlade(header, frame);
  geometry_msgs::TransformStamped transform = tf2::eigenToTransform(last_->T_camera_tool);
  transform.header = header;
  transform.child_frame_id = tool_frame_;
  tf_broadcaster_.sendTransform(transform);
}

void ToolTrackerNode::publishBlade(const std_msgs::Header& header, const RgbdFrame& frame) {
  const auto blade = boost::make_shared<geometry_msgs::PolygonStamped>();
  blade->header = header;
  blade->polygon = bladePolygon(tracker_->tool().blade, last_->T_camera_tool);
  blade_.publish(blade);
  if (!frame.placed) return;
  trail_->add(toNanoseconds(header.stamp), frame.T_fixed_camera * last_->T_camera_tool);
  if (marker_.getNumSubscribers() == 0) return;
  std_msgs::Header fixed = header;
  if (!output_frame_->name().empty()) fixed.frame_id = output_frame_->name();
  marker_.publish(boost::make_shared<visualization_msgs::MarkerArray>(trail_->markers(fixed)));
}

void ToolTrackerNode::diagnose(diagnostic_updater::DiagnosticStatusWrapper& status) const {
  using diagnostic_msgs::DiagnosticStatus;
  if (isSilent(last_arrival_)) {
    status.summary(DiagnosticStatus::WARN, silenceInWords());
    return;
  }
  if (!unusable_.empty()) {
    status.summary(DiagnosticStatus::ERROR, "frames come, but cannot be used: " + unusable_);
    return;
  }
  if (!watch_.missed().empty()) status.add("not seen in", watch_.missed());
  if (!last_) {
    status.summary(DiagnosticStatus::WARN, "not seen: " + tracker_->reason());
    return;
  }
  if (last_->bridged) {
    status.summary(DiagnosticStatus::WARN, "bridged by its motion: " + tracker_->reason());
  } else if (!not_placed_.empty()) {
    status.summary(DiagnosticStatus::WARN, "seen, but not predicted: " + not_placed_);
  } else {
    status.summary(DiagnosticStatus::OK, "seen");
  }
  status.add("markers", last_->markers);
  status.add("reprojection rms [px]", last_->reprojection_px);
  status.add("depth offset [m]", last_->depth_offset_m);
  status.add("position standard deviation [m]", std::sqrt(last_->covariance.topLeftCorner<3, 3>().trace()));
  status.add("rotation standard deviation [rad]",
             std::sqrt(last_->covariance.bottomRightCorner<3, 3>().trace()));
}

}  // namespace softbody
