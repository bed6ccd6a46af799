#include "softbody_recordings/ros/recorded_images.h"

#include <sensor_msgs/CameraInfo.h>

#include <set>
#include <vector>

#include "softbody_recordings/ros/typed_message.h"
#include "softbody_tracking/ros/compressed_image.h"

namespace softbody {
namespace {

/// Whether messages of a topic are those of a transport that is decoded here.
bool isTransported(const std::string& topic, const std::string& type) {
  return topic.find("/compressed") != std::string::npos &&
         type == messageType<sensor_msgs::CompressedImage>().name;
}

}  // namespace

CameraTopics recordedTopics(const rosbag::Bag& bag, const CameraTopics& wanted) {
  std::set<std::string> present;
  rosbag::View view(bag);
  for (const rosbag::ConnectionInfo* connection : view.getConnections()) present.insert(connection->topic);
  CameraTopics topics = wanted;
  const auto add = [&present](std::vector<std::string> transports, std::string* topic) {
    if (present.count(*topic) != 0) return;
    for (const std::string& transport : transports)
      if (present.count(*topic + transport) != 0) return void(*topic += transport);
  };
  add({"/compressed"}, &topics.color);
  add({"/compressedDepth", "/compressed"}, &topics.depth);
  return topics;
}

std::string imageTypeFault(const rosbag::ConnectionInfo& connection) {
  const bool transported = isTransported(connection.topic, connection.datatype);
  return typeFault(
      connection.datatype, connection.md5sum,
      transported ? messageType<sensor_msgs::CompressedImage>() : messageType<sensor_msgs::Image>());
}

std::string infoTypeFault(const rosbag::ConnectionInfo& connection) {
  return typeFault(connection.datatype, connection.md5sum, messageType<sensor_msgs::CameraInfo>());
}

sensor_msgs::ImageConstPtr recordedImage(const rosbag::MessageInstance& instance, const rosbag::Bag& bag) {
  if (isTransported(instance.getTopic(), instance.getDataType()))
    return decompressed(*instantiate<sensor_msgs::CompressedImage>(instance, bag));
  return instantiate<sensor_msgs::Image>(instance, bag);
}

}  // namespace softbody
