#include "recordings/recording.h"

#include <rosbag/bag.h>
#include <rosbag/view.h>

#include <boost/make_shared.hpp>
#include <filesystem>
#include <map>

namespace softbody::recordings {
namespace {

constexpr char kTruthTopology[] = "/ground_truth/surface/topology",
               kTruthState[] = "/ground_truth/surface/state";

template <typename Message, typename Set>
void read(const rosbag::Bag& bag, const std::string& topic, Set set) {
  rosbag::View view(bag, rosbag::TopicQuery(topic));
  for (const rosbag::MessageInstance& instance : view) set(*instance.instantiate<Message>());
}

/// A connection with the definition of another version.
boost::shared_ptr<ros::M_string> connectionWith(const std::string& md5sum, const std::string& topic) {
  const auto header = boost::make_shared<ros::M_string>();
  (*header)["topic"] = topic;
  (*header)["type"] = "sensor_msgs/Image";
  (*header)["md5sum"] = md5sum;
  (*header)["message_definition"] = "uint8 other";
  return header;
}

}  // namespace

Recording readRecording(const std::string& path, std::size_t count) {
  const rosbag::Bag bag(path, rosbag::bagmode::Read);
  Recording recording;
  std::map<ros::Time, Frame> frames;
  const CameraTopics& topics = recording.topics;
  read<sensor_msgs::Image>(bag, topics.color, [&](const auto& m) { frames[m.header.stamp].color = m; });
  read<sensor_msgs::Image>(bag, topics.depth, [&](const auto& m) { frames[m.header.stamp].depth = m; });
  read<sensor_msgs::CameraInfo>(bag, topics.color_info,
                                [&](const auto& m) { frames[m.header.stamp].color_info = m; });
  read<sensor_msgs::CameraInfo>(bag, topics.depth_info,
                                [&](const auto& m) { frames[m.header.stamp].depth_info = m; });
  read<softbody_msgs::MeshState>(bag, kTruthState, [&](const auto& m) { frames[m.header.stamp].truth = m; });
  read<softbody_msgs::MeshTopology>(bag, kTruthTopology, [&](const auto& m) { recording.topology = m; });
  read<tf2_msgs::TFMessage>(bag, "/tf_static", [&](const auto& m) { recording.tf_static = m; });
  for (const auto& [stamp, frame] : frames) {
    if (recording.frames.size() == count) break;
    recording.frames.push_back(frame);
    recording.frames.back().received = stamp;
  }
  return recording;
}

void writeRecording(const Recording& recording, const std::string& path) {
  rosbag::Bag bag(path, rosbag::bagmode::Write);
  const ros::Time start = recording.frames.front().received;
  bag.write("/tf_static", start, recording.tf_static);
  bag.write(kTruthTopology, start, recording.topology);
  const CameraTopics& topics = recording.topics;
  const auto depth_connection =
      recording.md5sum.empty() ? nullptr : connectionWith(recording.md5sum, topics.depth);
  for (const Frame& frame : recording.frames) {
    const ros::Time& time = frame.received;
    if (frame.color_info) bag.write(topics.color_info, time, *frame.color_info);
    if (frame.color && recording.compress_color)
      bag.write(topics.color + "/compressed", time, recording.compress_color(*frame.color));
    else if (frame.color)
      bag.write(topics.color, time, *frame.color);
    if (frame.depth_info) bag.write(topics.depth_info, time, *frame.depth_info);
    if (frame.depth && recording.compress_depth)
      bag.write(topics.depth + "/compressedDepth", time, recording.compress_depth(*frame.depth));
    else if (frame.depth)
      bag.write(topics.depth, time, *frame.depth, depth_connection);
    bag.write(kTruthState, time, frame.truth);
  }
  bag.close();
  if (recording.cut_bytes > 0)
    std::filesystem::resize_file(path, std::filesystem::file_size(path) - recording.cut_bytes);
}

}  // namespace softbody::recordings
