#include "nodes/output_frame.h"

#include <ros/ros.h>
#include <tf2_eigen/tf2_eigen.h>

namespace softbody {
namespace {

constexpr double kPoll_s = 0.002;

}  // namespace

OutputFrame::OutputFrame(Parameters& parameters)
    : name_(parameters.text("output_frame", "")),
      timeout_s_(parameters.number("tf_timeout_s", 0.05, 0.0, 5.0)),
      listener_(buffer_) {}

/// Waits in wall time: the time of a bag that is held would never run out.
Eigen::Isometry3d OutputFrame::lookUp(const std::string& target, const std::string& source,
                                      const ros::Time& stamp, double patience_s) const {
  const ros::WallTime deadline = ros::WallTime::now() + ros::WallDuration(patience_s);
  while (!buffer_.canTransform(target, source, stamp) && ros::ok() && ros::WallTime::now() < deadline) {
    ros::WallDuration(kPoll_s).sleep();
  }
  return tf2::transformToEigen(buffer_.lookupTransform(target, source, stamp));
}

Eigen::Isometry3d OutputFrame::poseOf(const std_msgs::Header& header) const {
  if (name_.empty() || name_ == header.frame_id) return Eigen::Isometry3d::Identity();
  return lookUp(name_, header.frame_id, header.stamp, timeout_s_);
}

}  // namespace softbody
