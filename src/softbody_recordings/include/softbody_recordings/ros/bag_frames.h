#pragma once

#include <rosbag/bag.h>
#include <rosbag/view.h>
#include <std_msgs/Header.h>

#include <functional>
#include <string>

#include "softbody_recordings/pairing/frame_pairer.h"
#include "softbody_tracking/camera/camera_ingest.h"

namespace softbody {

struct BagFramesConfig {
  std::string camera = "/camera";           ///< namespace of the camera's topics
  Nanoseconds sync_tolerance = 15'000'000;  ///< between colour and depth
};

/// What was read.
struct BagFramesReport {
  int frames = 0;
  int without_depth = 0;  ///< colour images that no depth image came near to, passed on without
  LeftOutImages left_out;
  int unusable = 0;        ///< images that could not be converted
  std::string last_error;  ///< of the last unusable one
};

/// Reads a bag's camera topics through the ingest, frame by frame in bag order.
/// @param use called with each frame, the colour image's header, and the share of the bag that has been read
/// (0..1).
/// @throw std::invalid_argument if a camera topic is missing; the sentence lists what the bag has.
BagFramesReport readBagFrames(
    const rosbag::Bag& bag, const BagFramesConfig& config, CameraIngest* ingest,
    const std::function<void(const RgbdFrame&, const std_msgs::Header&, double)>& use);

}  // namespace softbody
