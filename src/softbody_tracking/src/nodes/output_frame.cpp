#include "nodes/output_frame.h"

#include <fmt/format.h>
#include <ros/ros.h>

#include <stdexcept>

#include "softbody_common/ros/frame_name.h"
#include "softbody_common/ros/geometry_messages.h"

namespace softbody {
namespace {

constexpr double kPoll_s = 0.002;  // [s] between two looks at the tf buffer; short against a frame's 33 ms

}  // namespace

OutputFrame::OutputFrame(const OutputFrameOptions& options)
    : name_(frameName(options.name, "parameter output_frame")), timeout_s_(options.timeout_s) {}

std_msgs::Header OutputFrame::fixedHeader(const std_msgs::Header& camera_header) const {
  std_msgs::Header header = camera_header;
  if (!name_.empty()) header.frame_id = name_;
  return header;
}

Eigen::Isometry3d OutputFrame::cameraPose(const std_msgs::Header& camera_header) const {
  return poseOf(camera_header, camera_header.frame_id, timeout_s_);
}

Eigen::Isometry3d OutputFrame::poseOf(const std_msgs::Header& header, const std::string& camera_frame,
                                      double timeout_s) const {
  const std::string& fixed = name_.empty() ? camera_frame : name_;
  std_msgs::Header source = header;
  source.frame_id = source.frame_id.empty() ? camera_frame : frameName(source.frame_id, "a pose or blade");
  if (source.frame_id == fixed) return Eigen::Isometry3d::Identity();
  return lookUp(fixed, source, timeout_s);
}

Eigen::Isometry3d OutputFrame::newestPoseOf(const std_msgs::Header& header, const std::string& camera_frame,
                                            double longest_age_s) const {
  const std::string& fixed = name_.empty() ? camera_frame : name_;
  std_msgs::Header source = header;
  source.frame_id = withoutSlash(source.frame_id);
  if (source.frame_id == fixed) return Eigen::Isometry3d::Identity();
  if (!transforms_.buffer().canTransform(fixed, source.frame_id, source.stamp) &&
      transforms_.buffer().canTransform(fixed, source.frame_id, ros::Time(0))) {
    const ros::Time newest =
        transforms_.buffer().lookupTransform(fixed, source.frame_id, ros::Time(0)).header.stamp;
    const double age_s = (source.stamp - newest).toSec();
    if (age_s > longest_age_s)
      throw tf2::TransformException(
          fmt::format("the newest transform of {} is {:.1f} s older than the image", source.frame_id, age_s));
    if (age_s > 0.0) source.stamp = newest;
  }
  return lookUp(fixed, source, 0.0);
}

/// Waits in wall time: ROS time does not advance while a bag is paused.
Eigen::Isometry3d OutputFrame::lookUp(const std::string& target, const std_msgs::Header& source,
                                      double timeout_s) const {
  const ros::WallTime deadline = ros::WallTime::now() + ros::WallDuration(timeout_s);
  while (!transforms_.buffer().canTransform(target, source.frame_id, source.stamp) && ros::ok() &&
         ros::WallTime::now() < deadline) {
    ros::WallDuration(kPoll_s).sleep();
  }
  const std::string why = transforms_.whyMissing(target, source.frame_id);
  if (!why.empty()) throw tf2::TransformException(why);
  const auto T_target_source = transforms_.buffer().lookupTransform(target, source.frame_id, source.stamp);
  try {
    return fromMessage(T_target_source.transform);
  } catch (const std::invalid_argument& error) {
    throw tf2::TransformException(source.frame_id + " in " + target + ": " + error.what());
  }
}

}  // namespace softbody
