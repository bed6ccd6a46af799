#pragma once

#include <geometry_msgs/Point.h>
#include <geometry_msgs/Point32.h>
#include <geometry_msgs/Polygon.h>
#include <geometry_msgs/Pose.h>
#include <geometry_msgs/Transform.h>
#include <geometry_msgs/Vector3.h>

#include <vector>

#include "softbody_common/geometry/types.h"

/// Points and poses as messages. fromMessage and fromPoint32s throw std::invalid_argument, with the field,
/// for numbers that are not finite or beyond kLargestCoordinate_m.
namespace softbody {

geometry_msgs::Point pointMessage(const Eigen::Vector3d& point);
geometry_msgs::Vector3 vectorMessage(const Eigen::Vector3d& vector);

geometry_msgs::Point32 toPoint32(const Eigen::Vector3d& point);
/// Any numbers.
Eigen::Vector3d fromPoint32(const geometry_msgs::Point32& message);

std::vector<geometry_msgs::Point32> toPoint32s(const Points& points);
/// @param field names the points at the start of the message of the exception.
Points fromPoint32s(const std::vector<geometry_msgs::Point32>& message, const char* field);

geometry_msgs::Pose toMessage(const Eigen::Isometry3d& pose);
/// @throw std::invalid_argument also if the quaternion is not of unit length (within 1e-3).
Eigen::Isometry3d fromMessage(const geometry_msgs::Pose& pose);
Eigen::Isometry3d fromMessage(const geometry_msgs::Transform& transform);

/// Corners of a blade, #P by 3. @throw std::invalid_argument also if bladeFault() finds one.
Points fromMessage(const geometry_msgs::Polygon& blade);

}  // namespace softbody
