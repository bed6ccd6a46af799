#include "nodes/clicked_object.h"

#include <fmt/format.h>

#include <stdexcept>

#include "softbody_common/geometry/plausibility.h"
#include "softbody_common/ros/frame_name.h"
#include "softbody_common/ros/geometry_messages.h"

namespace softbody::scanning {

ClickedObject::ClickedObject(ros::NodeHandle node, std::string frame) : frame_(std::move(frame)) {
  subscriber_ = node.subscribe("clicked_point", 1, &ClickedObject::onPoint, this);
}

void ClickedObject::forget() {
  point_.reset();
  reason_.clear();
}

void ClickedObject::onPoint(const geometry_msgs::PointStamped& message) try {
  const Eigen::Vector3d point(message.point.x, message.point.y, message.point.z);
  if (!isPlausible(point))
    throw std::invalid_argument(
        fmt::format("({:.6g}, {:.6g}, {:.6g}) must be finite and within {:.0f} m of the origin", point.x(),
                    point.y(), point.z(), kLargestCoordinate_m));
  const std::string frame = frameName(message.header.frame_id, subscriber_.getTopic());
  if (frame.empty()) throw std::invalid_argument("it has no frame_id");
  point_ = frame == frame_ ? point : poseOf(frame, message.header.stamp) * point;
  reason_.clear();
  ROS_INFO_STREAM(fmt::format("the object is what stands at ({:.3f}, {:.3f}, {:.3f}) m in '{}'", point_->x(),
                              point_->y(), point_->z(), frame_));
} catch (const std::exception& error) {  // also of tf2
  reason_ = fmt::format("the clicked point is not used: {}", error.what());
  ROS_WARN_STREAM(reason_);
}

/// At the stamp, or the latest: rviz stamps a click with the time of the click, later than any image.
Eigen::Isometry3d ClickedObject::poseOf(const std::string& frame, const ros::Time& stamp) const {
  const std::string why = transforms_.whyMissing(frame_, frame);
  if (!why.empty()) throw std::invalid_argument(why);
  const tf2_ros::Buffer& buffer = transforms_.buffer();
  const ros::Time time = buffer.canTransform(frame_, frame, stamp) ? stamp : ros::Time();
  return fromMessage(buffer.lookupTransform(frame_, frame, time).transform);
}

}  // namespace softbody::scanning
