#include "softbody_recordings/ros/injector_node.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <sensor_msgs/CameraInfo.h>

#include <string>
#include <vector>

#include "nodes/live_stream.h"
#include "softbody_common/protocol/topics.h"
#include "softbody_common/ros/ros_parameters.h"
#include "softbody_recordings/injection/injector_options.h"

namespace softbody::injection {
namespace {

constexpr std::uint32_t kCameraInfoQueue = 30;

/// "camera/color/image_raw" as "camera_faulty/color/image_raw".
std::string faulty(const std::string& topic) {
  const std::size_t slash = topic.find('/');
  return topic.substr(0, slash) + "_faulty" + topic.substr(slash);
}

ros::Subscriber relay(ros::NodeHandle* handle, const std::string& topic, ros::Publisher* publisher) {
  *publisher = handle->advertise<sensor_msgs::CameraInfo>(faulty(topic), kCameraInfoQueue);
  const boost::function<void(const sensor_msgs::CameraInfoConstPtr&)> pass =
      [publisher](const sensor_msgs::CameraInfoConstPtr& info) { publisher->publish(info); };
  return handle->subscribe<sensor_msgs::CameraInfo>(topic, kCameraInfoQueue, pass);
}

}  // namespace

InjectorNode::InjectorNode(ros::NodeHandle handle, const ros::NodeHandle& private_handle) {
  InjectorOptions options = readOptions(private_handle, injectorParameters());
  options.deliveries.seed = options.images.seed = options.seed;
  const auto stream = [&](const char* topic, bool is_depth) {
    const bool wanted = options.stream != (is_depth ? "color" : "depth");
    return std::make_unique<LiveStream>(&handle, topic, faulty(topic), is_depth,
                                        wanted ? options.deliveries : DeliveryFaults(), options.images);
  };
  relayInfos(&handle);
  color_ = stream(topics::kCameraColor, false);
  depth_ = stream(topics::kCameraDepth, true);
  diagnostics_.emplace(handle, private_handle, "faults", [this](auto& status) { diagnose(status); });
}

InjectorNode::~InjectorNode() = default;

void InjectorNode::diagnose(NodeDiagnostics::Status& status) {
  using diagnostic_msgs::DiagnosticStatus;
  status.summary(DiagnosticStatus::OK, "images pass, with faults");
  std::vector<std::string> silent;
  for (LiveStream* stream : {color_.get(), depth_.get()}) {
    const LiveStream::Counts counts = stream->takeCounts();
    if (counts.in == 0) silent.push_back(stream->topic());
    status.add(stream->topic() + ", images in", counts.in);
    status.add(stream->topic() + ", images out", counts.out);
    status.add(stream->topic() + ", images refused", counts.refused);
    if (counts.refused > 0)
      status.mergeSummary(DiagnosticStatus::WARN,
                          fmt::format("{} images of {} cannot be used", counts.refused, stream->topic()));
  }
  if (!silent.empty())
    status.mergeSummary(DiagnosticStatus::WARN,
                        fmt::format("no image in the last second on {}", fmt::join(silent, ", ")));
}

void InjectorNode::relayInfos(ros::NodeHandle* handle) {
  color_info_subscriber_ = relay(handle, topics::kCameraColorInfo, &color_info_);
  depth_info_subscriber_ = relay(handle, topics::kCameraDepthInfo, &depth_info_);
}

}  // namespace softbody::injection
