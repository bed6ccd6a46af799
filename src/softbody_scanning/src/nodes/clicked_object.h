#pragma once

#include <geometry_msgs/PointStamped.h>
#include <ros/ros.h>

#include <optional>
#include <string>

#include "softbody_common/ros/transform_input.h"

namespace softbody::scanning {

/// Which thing on the table is the object: the last point on clicked_point, where rviz's tool Publish Point
/// sends what is clicked.
class ClickedObject {
 public:
  /// @param frame in which the point is wanted.
  ClickedObject(ros::NodeHandle node, std::string frame);

  void forget();
  const std::optional<Eigen::Vector3d>& point() const { return point_; }  ///< [m]
  /// Why the last point is not used; empty: it is, or there was none.
  const std::string& reason() const { return reason_; }

 private:
  void onPoint(const geometry_msgs::PointStamped& message);
  Eigen::Isometry3d poseOf(const std::string& frame, const ros::Time& stamp) const;

  std::string frame_;
  TransformInput transforms_;
  std::optional<Eigen::Vector3d> point_;
  std::string reason_;
  ros::Subscriber subscriber_;
};

}  // namespace softbody::scanning
