#include "softbody_recordings/ros/recorded_images.h"

#include <set>
#include <string>

#include "softbody_tracking/ros/compressed_image.h"

namespace softbody {

CameraTopics recordedTopics(const rosbag::Bag& bag, const CameraTopics& wanted) {
  std::set<std::string> present;
  rosbag::View view(bag);
  for (const rosbag::ConnectionInfo* connection : view.getConnections()) present.insert(connection->topic);
  CameraTopics topics = wanted;
  for (std::string* topic : {&topics.color, &topics.depth}) {
    if (present.count(*topic) != 0) continue;
    for (const char* transport : {"/compressed", "/compressedDepth"})
      if (present.count(*topic + transport) != 0) *topic += transport;
  }
  return topics;
}

sensor_msgs::ImageConstPtr recordedImage(const rosbag::MessageInstance& instance) {
  const bool transported = instance.getTopic().find("/compressed") != std::string::npos;
  const auto compressed = transported ? instance.instantiate<sensor_msgs::CompressedImage>() : nullptr;
  if (compressed) return decompressed(*compressed);
  return instance.instantiate<sensor_msgs::Image>();
}

}  // namespace softbody
