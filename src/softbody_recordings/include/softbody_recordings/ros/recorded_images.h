#pragma once

#include <rosbag/bag.h>
#include <rosbag/view.h>
#include <sensor_msgs/Image.h>

#include <string>

#include "softbody_common/protocol/camera_topics.h"

namespace softbody {

/// The topics under which a bag holds the images: where it has no raw ones, "/compressed" or
/// "/compressedDepth" is added to the name.
CameraTopics recordedTopics(const rosbag::Bag& bag, const CameraTopics& wanted);

/// Why a bag's messages on a topic cannot be read as images, or as CameraInfo; empty: they can.
std::string imageTypeFault(const rosbag::ConnectionInfo& connection);
std::string infoTypeFault(const rosbag::ConnectionInfo& connection);

/// An image of either type, decompressed.
/// @throw std::invalid_argument if it has another type, or if a compressed image cannot be decoded.
sensor_msgs::ImageConstPtr recordedImage(const rosbag::MessageInstance& instance, const rosbag::Bag& bag);

}  // namespace softbody
