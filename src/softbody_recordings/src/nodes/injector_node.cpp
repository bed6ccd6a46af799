#include "softbody_recordings/ros/injector_node.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <sensor_msgs/CameraInfo.h>

#include <string>
#include <vector>

#include "nodes/live_stream.h"
#include "softbody_common/ros/ros_parameters.h"
#include "softbody_common/topics.h"
#include "softbody_recordings/injection/fault_options.h"

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
  Parameters parameters = readParameters(private_handle);
  readFaults(&parameters);
  warnUnknown(parameters);
  const auto stream = [&](const char* topic, bool is_depth) {
    const bool wanted = is_depth ? in_depth_ : in_color_;
    return std::make_unique<LiveStream>(&handle, topic, faulty(topic), is_depth,
                                        wanted ? deliveries_ : DeliveryFaults(), images_);
  };
  relayInfos(&handle);
  color_ = stream(topics::kCameraColor, false);
  depth_ = stream(topics::kCameraDepth, true);
  diagnostics_.emplace(handle, private_handle, "faults", [this](auto& status) { diagnose(status); });
}

InjectorNode::~InjectorNode() = default;

void InjectorNode::readFaults(Parameters* parameters) {
  deliveries_.seed = images_.seed = static_cast<std::uint64_t>(parameters->integer("seed", 1, 0, 1 << 30));
  const std::string stream = parameters->choice("stream", "both", {"color", "depth", "both"});
  in_color_ = stream != "depth";
  in_depth_ = stream != "color";
  for (const FaultOption& option : faultOptions(&deliveries_, &images_)) {
    const std::string key = option.unit.empty() ? option.name : option.name + "_" + option.unit;
    *option.value = parameters->number(key, *option.value, option.least, option.most);
  }
}

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
