#pragma once

#include <rosbag/bag.h>
#include <rosbag/view.h>
#include <sensor_msgs/Image.h>
#include <std_msgs/Header.h>

#include <functional>
#include <map>
#include <string>

#include "softbody_common/protocol/camera_topics.h"
#include "softbody_recordings/validation/recording_facts.h"
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
  int without_depth = 0;  ///< of these, usable frames with a colour image only
  int unusable = 0;       ///< of these, frames whose images could not be converted
  int undecoded = 0;      ///< compressed images that are damaged
  std::map<std::string, validation::Unusable> reasons;  ///< of the unusable frames, and of the damaged images
  std::string last_error;                               ///< the last of the reasons
  UnpairedImages unpaired;

  int withDepth() const { return frames - unusable - without_depth; }
};

/// Who reads a bag.
struct BagFramesUse {
  /// A frame's images, the colour image's header (its frame without a leading slash), and the progress
  /// through the bag (0..1).
  std::function<void(const CameraImages&, const std_msgs::Header&, double)> frame;
  /// What is said once about the camera.
  std::function<void(const std::string&)> note = [](const std::string&) {};
  /// Each message of the camera's topics, and its image; null: it is damaged, or no image.
  std::function<void(const rosbag::MessageInstance&, const sensor_msgs::Image*)> message =
      [](const rosbag::MessageInstance&, const sensor_msgs::Image*) {};
  /// Whether no further frame is wanted.
  std::function<bool()> enough = [] { return false; };
};

/// Reads a bag's camera topics. The frames are those that camera_ingest makes when the bag is played, except
/// that frames before the first camera_info have the first one.
/// @throw std::invalid_argument if a camera topic is missing; the sentence lists what the bag has; or if the
/// messages of a topic have another type.
BagFramesReport readBagImages(const rosbag::Bag& bag, const BagFramesConfig& config, const BagFramesUse& use);

/// The same through the ingest. @param use as BagFramesUse::frame. @param note as BagFramesUse::note.
BagFramesReport readBagFrames(
    const rosbag::Bag& bag, const BagFramesConfig& config, CameraIngest* ingest,
    const std::function<void(const RgbdFrame&, const std_msgs::Header&, double)>& use,
    const std::function<void(const std::string&)>& note = [](const std::string&) {});

}  // namespace softbody
