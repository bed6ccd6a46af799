#include "nodes/tool_tracker/tool_tracker_node.h"

#include <cmath>
#include <stdexcept>
#include <utility>

#include "softbody_common/protocol/topics.h"
#include "softbody_common/ros/frame_name.h"
#include "softbody_common/ros/ros_parameters.h"
#include "softbody_tracking/tool/marker_absence.h"

namespace softbody {
namespace {

ToolDescription loadTool(const ToolTrackerOptions& options) {
  ToolDescription tool = loadToolDescription(options.tool, fileScope(options.allow_outside));
  for (const std::string& warning : tool.warnings) ROS_WARN_STREAM(warning);
  tool = inFrame(std::move(tool), options.blade_frame);
  tool.frame = frameName(tool.frame, "the tool");
  return tool;
}

/// @throw std::invalid_argument if the tool's own frame is the one that it follows.
std::string requireOther(const std::string& own_frame, const std::string& followed) {
  if (own_frame == followed)
    throw std::invalid_argument("the tool follows the frame '" + own_frame +
                                "', which this node itself sends; set tool_frame to another name");
  return own_frame;
}

}  // namespace

ToolTrackerNode::ToolTrackerNode(const ros::NodeHandle& handle, const ros::NodeHandle& private_handle)
    : ToolTrackerNode(handle, private_handle, readOptions(private_handle, toolTrackerNodeParameters())) {}

ToolTrackerNode::ToolTrackerNode(const ros::NodeHandle& handle, const ros::NodeHandle& private_handle,
                                 const ToolTrackerOptions& options)
    : output_frame_(options.output_frame),
      tracker_(loadTool(options), options.tracker),
      publisher_(
          handle, tracker_.tool().blade,
          output_frame_.claim(requireOther(ownFrame(options.tool_frame, "tool_frame", private_handle, "tool"),
                                           tracker_.tool().frame))),
      stamps_(handle.resolveName(topics::kRgbRect)),
      images_(handle, [this](const RectifiedImages& images) { onFrame(images); }),
      diagnostics_(handle, private_handle, "tool", [this](auto& status) { diagnose(status); }) {}

void ToolTrackerNode::onFrame(const RectifiedImages& images) try {
  watchdog_.frameArrived();
  const std_msgs::Header& header = images.color->header;
  RgbdFrame frame = frameFromImages(images);
  if (!stamps_.admits(header.stamp)) return;
  frame.pass = stamps_.pass();
  placeCamera(header, &frame);
  StageTimer timer;
  const bool follows = !tracker_.tool().frame.empty();
  last_ = follows ? tracker_.follow(frame.stamp, placeOfTool(header, frame)) : tracker_.track(frame, &timer);
  frame_error_.clear();
  const auto warning = dropouts_.update(frame.stamp, last_, tracker_.reason(),
                                        [&] { return whyMarkersAreMissed(tracker_.tool(), frame.color); });
  if (warning) ROS_WARN_STREAM(*warning);
  if (last_) publish(header, frame);
  publisher_.publishTiming(header, timer.take());
} catch (const std::exception& error) {
  frame_error_ = error.what();
  ROS_ERROR_STREAM_THROTTLE(
      5.0, "the tool cannot be tracked in frame " << images.color->header.stamp << ": " << error.what());
}

void ToolTrackerNode::placeCamera(const std_msgs::Header& header, RgbdFrame* frame) try {
  frame->T_fixed_camera = output_frame_.cameraPose(header);
  tf_error_.clear();
} catch (const tf2::TransformException& error) {
  frame->placed = false;
  tf_error_ = "tf does not say where " + header.frame_id + " is in output_frame " + output_frame_.name() +
              ": " + error.what();
  ROS_WARN_STREAM_THROTTLE(5.0, "the tool is not predicted and has no trail: " << tf_error_);
}

std::optional<Eigen::Isometry3d> ToolTrackerNode::placeOfTool(const std_msgs::Header& header,
                                                              const RgbdFrame& frame) try {
  if (!frame.placed) return std::nullopt;
  std_msgs::Header tool = header;
  tool.frame_id = tracker_.tool().frame;
  const Eigen::Isometry3d T_fixed_tool =
      output_frame_.poseOf(tool, header.frame_id, output_frame_.timeout_s());
  tool_tf_error_.clear();
  return frame.T_fixed_camera.inverse() * T_fixed_tool;
} catch (const tf2::TransformException& error) {
  tool_tf_error_ = error.what();
  ROS_WARN_STREAM_THROTTLE(5.0, "the blade cuts nothing: tf does not say where "
                                    << tracker_.tool().frame << " is: " << tool_tf_error_);
  return std::nullopt;
}

void ToolTrackerNode::publish(const std_msgs::Header& header, const RgbdFrame& frame) {
  publisher_.publishPose(header, *last_);
  if (!last_->cuts) return;
  publisher_.publishBlade(header, last_->T_camera_tool);
  if (frame.placed)
    publisher_.publishTrail(output_frame_.fixedHeader(header), frame.T_fixed_camera * last_->T_camera_tool);
}

void ToolTrackerNode::diagnose(NodeDiagnostics::Status& status) const {
  using diagnostic_msgs::DiagnosticStatus;
  if (watchdog_.isExpired()) return status.summary(DiagnosticStatus::WARN, watchdog_.message());
  if (!frame_error_.empty())
    return status.summary(DiagnosticStatus::ERROR, "frames come, but cannot be used: " + frame_error_);
  status.add("frames dropped to keep up", images_.dropped());
  if (!dropouts_.missedFrames().empty()) status.add("not seen in", dropouts_.missedFrames());
  if (!dropouts_.cause().empty()) status.add("cause", dropouts_.cause());
  if (!last_) {
    std::string cause = dropouts_.cause().empty() ? tracker_.reason() : dropouts_.cause();
    if (!tool_tf_error_.empty()) cause += ": " + tool_tf_error_;
    return status.summary(DiagnosticStatus::WARN, "not seen: " + cause);
  }
  if (last_->bridged) {
    status.summary(DiagnosticStatus::WARN, "bridged by its motion: " + tracker_.reason());
  } else if (!tracker_.reason().empty()) {
    status.summary(DiagnosticStatus::WARN, "seen, but does not cut: " + tracker_.reason());
  } else if (!tf_error_.empty()) {
    status.summary(DiagnosticStatus::WARN, "seen, but not predicted: " + tf_error_);
  } else {
    status.summary(DiagnosticStatus::OK, "seen");
  }
  diagnoseObservation(status);
}

void ToolTrackerNode::diagnoseObservation(NodeDiagnostics::Status& status) const {
  status.add("markers", last_->markers);
  status.add("reprojection rms [px]", last_->reprojection_px);
  status.add("depth offset [m]", last_->depth_offset_m);
  status.add("position standard deviation [m]", std::sqrt(last_->covariance.topLeftCorner<3, 3>().trace()));
  status.add("rotation standard deviation [rad]",
             std::sqrt(last_->covariance.bottomRightCorner<3, 3>().trace()));
}

}  // namespace softbody
