#include "softbody_tracking/ros/tool_messages.h"

#include "softbody_common/ros/conversions.h"

namespace softbody {

geometry_msgs::PoseWithCovariance toMessage(const ToolObservation& observation) {
  geometry_msgs::PoseWithCovariance message;
  message.pose = toMessage(observation.T_camera_tool);
  Eigen::Map<Eigen::Matrix<double, 6, 6, Eigen::RowMajor>>(message.covariance.data()) =
      observation.covariance;
  return message;
}

geometry_msgs::Polygon bladePolygon(const Points& blade, const Eigen::Isometry3d& T) {
  geometry_msgs::Polygon polygon;
  for (Eigen::Index i = 0; i < blade.rows(); ++i) {
    const Eigen::Vector3f corner = (T * Eigen::Vector3d(blade.row(i))).cast<float>();
    geometry_msgs::Point32 point;
    point.x = corner.x();
    point.y = corner.y();
    point.z = corner.z();
    polygon.points.push_back(point);
  }
  return polygon;
}

}  // namespace softbody
