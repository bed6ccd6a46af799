#pragma once

#include <rosbag/bag.h>
#include <rosbag/view.h>
#include <std_msgs/Header.h>

#include <functional>
#include <string>

#include "softbody_common/camera_topics.h"
#include "softbody_tracking/camera/camera_ingest.h"
#include "softbody_tracking/camera/frame_pairer.h"

namespace softbody {

struct BagFramesConfig {
  CameraTopics camera = "/camera";
  PairingConfig pairing;  ///< as camera_ingest's
};

/// What was read.
struct BagFramesReport {
  int frames = 0;
  int without_depth = 0;   ///< of these, frames with a colour image only
  int unusable = 0;        ///< of these, frames whose images could not be converted
  int undecoded = 0;       ///< compressed images that are damaged
  std::string last_error;  ///< of the last unusable one
  UnpairedImages unpaired;
};

/// Reads a bag's camera topics through the ingest. The frames are those that camera_ingest makes when the bag
/// is played.
/// @param use called with each frame, the colour image's header, and the progress through the bag (0..1).
/// @throw std::invalid_argument if a camera topic is missing; the sentence lists what the bag has.
BagFramesReport readBagFrames(
    const rosbag::Bag& bag, const BagFramesConfig& config, CameraIngest* ingest,
    const std::function<void(const RgbdFrame&, const std_msgs::Header&, double)>& use);

}  // namespace softbody
