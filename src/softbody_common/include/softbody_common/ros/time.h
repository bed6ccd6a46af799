#pragma once

#include <ros/time.h>

#include "softbody_common/time/time.h"

/// ros::Time throws where a difference exceeds 2^31 s or a sum 2^32 s. So the nodes and tools compute in
/// nanoseconds.
namespace softbody {

Nanoseconds toNanoseconds(const ros::Time& time);
/// The nearest time that a message can hold.
ros::Time toTime(Nanoseconds time);
/// The nearest duration that ROS can hold, within 2^31 s.
ros::Duration toDuration(Nanoseconds duration);

/// [s]; below 0 if `to` is earlier.
double secondsBetween(const ros::Time& from, const ros::Time& to);

}  // namespace softbody
