#pragma once

#include <sensor_msgs/CameraInfo.h>

#include "softbody_common/geometry/pinhole.h"

/// The camera's description as a message.
namespace softbody {

/// The camera of the projection matrix P, or of K if P is zero.
/// @throw std::invalid_argument unless the image is not empty, has at most kLargestImageSide pixels a side,
/// and focal lengths and centre are plausible for its size.
Pinhole pinholeFromMessage(const sensor_msgs::CameraInfo& info);
/// A CameraInfo without distortion.
sensor_msgs::CameraInfo toMessage(const Pinhole& camera);

}  // namespace softbody
