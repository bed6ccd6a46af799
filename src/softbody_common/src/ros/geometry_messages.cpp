#include "softbody_common/ros/geometry_messages.h"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>
#include <string>

#include "softbody_common/cutting/blade.h"
#include "softbody_common/geometry/plausibility.h"

namespace softbody {
namespace {

constexpr double kQuaternionTolerance = 1e-3;  // the values were rounded to float

/// @param what the pose is of.
Eigen::Isometry3d poseOf(const Eigen::Vector3d& t, const Eigen::Quaterniond& q, const char* what) {
  if (!isPlausible(t) || !(std::abs(q.norm() - 1.0) < kQuaternionTolerance)) {
    throw std::invalid_argument(
        fmt::format("{} ({:.6g} {:.6g} {:.6g}; {:.6g} {:.6g} {:.6g} {:.6g}) is not usable: the position must "
                    "be finite and "
                    "within {:.0f} m of the origin, the quaternion of length 1",
                    what, t.x(), t.y(), t.z(), q.x(), q.y(), q.z(), q.w(), kLargestCoordinate_m));
  }
  return Eigen::Translation3d(t) * q.normalized();
}

}  // namespace

geometry_msgs::Point pointMessage(const Eigen::Vector3d& point) {
  geometry_msgs::Point message;
  message.x = point.x();
  message.y = point.y();
  message.z = point.z();
  return message;
}

geometry_msgs::Vector3 vectorMessage(const Eigen::Vector3d& vector) {
  geometry_msgs::Vector3 message;
  message.x = vector.x();
  message.y = vector.y();
  message.z = vector.z();
  return message;
}

geometry_msgs::Point32 toPoint32(const Eigen::Vector3d& p) {
  geometry_msgs::Point32 message;
  message.x = static_cast<float>(p.x());
  message.y = static_cast<float>(p.y());
  message.z = static_cast<float>(p.z());
  return message;
}

Eigen::Vector3d fromPoint32(const geometry_msgs::Point32& message) {
  return {message.x, message.y, message.z};
}

std::vector<geometry_msgs::Point32> toPoint32s(const Points& points) {
  std::vector<geometry_msgs::Point32> message(static_cast<std::size_t>(points.rows()));
  for (std::size_t i = 0; i < message.size(); ++i)
    message[i] = toPoint32(points.row(static_cast<Eigen::Index>(i)));
  return message;
}

Points fromPoint32s(const std::vector<geometry_msgs::Point32>& message, const char* field) {
  Points points(static_cast<Eigen::Index>(message.size()), 3);
  for (std::size_t i = 0; i < message.size(); ++i) {
    const Eigen::Vector3d point = fromPoint32(message[i]);
    if (!isPlausible(point)) {
      throw std::invalid_argument(
          fmt::format("{}[{}] is ({:.6g}, {:.6g}, {:.6g}); allowed: finite, within {:.0f} m of the origin",
                      field, i, point.x(), point.y(), point.z(), kLargestCoordinate_m));
    }
    points.row(static_cast<Eigen::Index>(i)) = point;
  }
  return points;
}

geometry_msgs::Pose toMessage(const Eigen::Isometry3d& pose) {
  const Eigen::Quaterniond q(pose.linear());
  geometry_msgs::Pose message;
  message.position = pointMessage(pose.translation());
  message.orientation.x = q.x();
  message.orientation.y = q.y();
  message.orientation.z = q.z();
  message.orientation.w = q.w();
  return message;
}

Eigen::Isometry3d fromMessage(const geometry_msgs::Pose& pose) {
  const auto& q = pose.orientation;
  return poseOf({pose.position.x, pose.position.y, pose.position.z}, {q.w, q.x, q.y, q.z}, "pose");
}

Eigen::Isometry3d fromMessage(const geometry_msgs::Transform& transform) {
  const auto& t = transform.translation;
  const auto& q = transform.rotation;
  return poseOf({t.x, t.y, t.z}, {q.w, q.x, q.y, q.z}, "transform");
}

Points fromMessage(const geometry_msgs::Polygon& blade) {
  // Before the conversion: its cost grows with the corners.
  requireBladeCorners(blade.points.size());
  Points corners = fromPoint32s(blade.points, "polygon.points");
  const std::string fault = bladeFault(corners);
  if (!fault.empty()) throw std::invalid_argument("the blade " + fault);
  return corners;
}

}  // namespace softbody
