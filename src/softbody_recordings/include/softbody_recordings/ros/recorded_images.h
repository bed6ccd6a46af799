#pragma once

#include <rosbag/bag.h>
#include <rosbag/view.h>
#include <sensor_msgs/Image.h>

#include "softbody_common/camera_topics.h"

namespace softbody {

/// The topics under which a bag holds the images: where it has no raw ones, "/compressed" or
/// "/compressedDepth" is added to the name.
CameraTopics recordedTopics(const rosbag::Bag& bag, const CameraTopics& wanted);

/// An image of either type, decompressed; null if the message has another type.
/// @throw std::invalid_argument if a compressed image cannot be decoded.
sensor_msgs::ImageConstPtr recordedImage(const rosbag::MessageInstance& instance);

}  // namespace softbody
