#include "nodes/tool_tracker/tool_publisher.h"

#include <geometry_msgs/PolygonStamped.h>
#include <geometry_msgs/PoseWithCovarianceStamped.h>
#include <softbody_msgs/StageTiming.h>
#include <tf2_eigen/tf2_eigen.h>

#include <boost/make_shared.hpp>
#include <utility>

#include "softbody_common/protocol/topics.h"
#include "softbody_common/ros/conversions.h"
#include "softbody_tracking/ros/tool_messages.h"

namespace softbody {

ToolPublisher::ToolPublisher(ros::NodeHandle handle, const Points& blade, std::string tool_frame)
    : tool_frame_(std::move(tool_frame)), blade_(blade) {
  pose_publisher_ = handle.advertise<geometry_msgs::PoseWithCovarianceStamped>(topics::kToolPose, 1);
  timing_publisher_ = handle.advertise<softbody_msgs::StageTiming>(topics::kTiming, 1);
  if (blade.rows() == 0) return;
  blade_publisher_ = handle.advertise<geometry_msgs::PolygonStamped>(topics::kToolBlade, 1);
  marker_publisher_ = handle.advertise<visualization_msgs::MarkerArray>(topics::kToolMarker, 1);
  trail_.emplace(blade);
}

void ToolPublisher::publishPose(const std_msgs::Header& camera_header, const ToolObservation& observation) {
  const auto pose = boost::make_shared<geometry_msgs::PoseWithCovarianceStamped>();
  pose->header = camera_header;
  pose->pose = toMessage(observation);
  pose_publisher_.publish(pose);
  if (observation.ambiguous) return;  // a transform has no covariance that could say so
  geometry_msgs::TransformStamped transform = tf2::eigenToTransform(observation.T_camera_tool);
  transform.header = camera_header;
  transform.child_frame_id = tool_frame_;
  tf_broadcaster_.sendTransform(transform);
}

void ToolPublisher::publishBlade(const std_msgs::Header& camera_header,
                                 const Eigen::Isometry3d& T_camera_tool) const {
  if (!trail_) return;
  const auto blade = boost::make_shared<geometry_msgs::PolygonStamped>();
  blade->header = camera_header;
  blade->polygon = bladePolygon(blade_, T_camera_tool);
  blade_publisher_.publish(blade);
}

void ToolPublisher::publishTrail(const std_msgs::Header& fixed_header,
                                 const Eigen::Isometry3d& T_fixed_tool) {
  if (!trail_) return;
  trail_->add(toNanoseconds(fixed_header.stamp), T_fixed_tool);
  if (marker_publisher_.getNumSubscribers() == 0) return;
  marker_publisher_.publish(
      boost::make_shared<visualization_msgs::MarkerArray>(trail_->markers(fixed_header)));
}

void ToolPublisher::publishTiming(const std_msgs::Header& camera_header,
                                  const std::vector<StageTime>& stages) const {
  softbody_msgs::StageTiming timing = timingMessage("tool_tracker", stages);
  timing.header = camera_header;
  timing_publisher_.publish(timing);
}

}  // namespace softbody
