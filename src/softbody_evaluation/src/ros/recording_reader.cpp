#include "ros/recording_reader.h"

#include <fmt/format.h>

#include <stdexcept>

#include "ros/typed_topic.h"
#include "softbody_recordings/ros/bag_frames.h"
#include "softbody_recordings/ros/input_bag.h"
#include "softbody_recordings/ros/recorded_images.h"
#include "softbody_tracking/ros/conversions.h"

namespace softbody::evaluation {

void readRecording(const std::string& path, const CameraTopics& camera,
                   const std::function<void(const RecordedFrame&)>& use) {
  const rosbag::Bag bag = openBag(path);
  BagFramesConfig config;
  config.camera = camera;
  config.pairing.every_color = true;
  CameraIngestConfig everything;
  everything.keep_all_depth = true;
  CameraIngest ingest(everything);
  BagFramesUse rectify;
  rectify.frame = [&](const CameraImages& images, const std_msgs::Header& header, double) {
    RgbdFrame frame = ingest.process(images);
    cv::patchNaNs(frame.depth, 0.0);
    if (images.depth.empty()) frame.depth.release();
    use({frame.stamp, header.frame_id, frame.camera, frame.color, frame.depth});
  };
  const BagFramesReport report = readBagImages(bag, config, rectify);
  if (report.frames == report.unusable)
    throw std::invalid_argument(fmt::format("{} holds no usable frame{}{}", path,
                                            report.last_error.empty() ? "" : ": ", report.last_error));
}

std::string recordingFrame(const std::string& path, const CameraTopics& camera) {
  const rosbag::Bag bag = openBag(path);
  const CameraTopics topics = recordedTopics(bag, camera);
  requireTopic(bag, topics.color);
  std::string why;
  rosbag::View view(bag, rosbag::TopicQuery(topics.color));
  for (const rosbag::MessageInstance& instance : view) {
    try {
      return withoutSlash(recordedImage(instance, bag)->header.frame_id);
    } catch (const std::invalid_argument& error) {  // damaged
      why = error.what();
    }
  }
  throw std::invalid_argument(fmt::format("{}: {} has no usable image: {}", path, topics.color, why));
}

bool hasRecording(const std::string& path, const CameraTopics& camera) {
  const rosbag::Bag bag = openBag(path);
  const CameraTopics topics = recordedTopics(bag, camera);
  for (const std::string& topic : {topics.color, topics.depth, topics.color_info}) {
    if (rosbag::View(bag, rosbag::TopicQuery(topic)).size() == 0) return false;
  }
  return true;
}

}  // namespace softbody::evaluation
