#include "camera/stream_advice.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <vector>

namespace softbody {
namespace {

using Types = std::map<std::string, std::string>;

constexpr char kImage[] = "sensor_msgs/Image", kCompressed[] = "sensor_msgs/CompressedImage",
               kInfo[] = "sensor_msgs/CameraInfo";

struct StreamWords {
  const char *argument, *transport, *type, *without;
};

/// @return the launch arguments of a stream, its type, and what to do if nothing like it is published.
StreamWords wordsOf(Stream stream) {
  switch (stream) {
    case Stream::kColor:
      return {"color", "color_transport", kImage, "no colour image is published: start the camera's driver"};
    case Stream::kColorInfo:
      return {
          "color_info", "", kInfo,
          "no calibration is published: calibrate the camera (camera_calibration), and give the driver the "
          "file (camera_info_url)"};
    default:
      return {"depth", "depth_transport", kImage,
              "no depth image is published: switch on the driver's registered depth (RealSense: "
              "align_depth:=true, OpenNI2: depth_registration:=true)"};
  }
}

bool contains(const std::string& text, const char* part) { return text.find(part) != std::string::npos; }

/// Whether a topic's name fits the stream.
bool fits(Stream stream, const std::string& topic) {
  const bool other = contains(topic, "infra") || contains(topic, "/ir") || contains(topic, "disparity") ||
                     contains(topic, "confidence");
  const bool depth = contains(topic, "depth") && !contains(topic, "rgb_to_depth");
  return !other && depth == (stream == Stream::kDepth);
}

std::vector<std::string> candidates(Stream stream, const char* type, const Types& published) {
  std::vector<std::string> found;
  for (const auto& [topic, its_type] : published) {
    const bool wanted = its_type == type || (type == kImage && its_type == kCompressed);
    if (wanted && fits(stream, topic)) found.push_back(fmt::format("{} ({})", topic, its_type));
  }
  return found;
}

/// Whether the images of a topic are published, in any transport.
bool isPublished(const std::string& topic, const Types& published) {
  return published.count(topic) + published.count(topic + "/compressed") +
             published.count(topic + "/compressedDepth") >
         0;
}

/// The length of the namespace that colour and depth share; 0: none.
std::size_t cameraLength(const std::string& color, const std::string& depth) {
  const auto end = std::mismatch(color.begin(), color.end(), depth.begin(), depth.end()).first;
  const std::size_t slash = color.rfind('/', static_cast<std::size_t>(end - color.begin()));
  return slash == std::string::npos ? 0 : slash;
}

/// Namespaces in which a camera has colour and depth under the same names as `topics`.
std::vector<std::string> otherCameras(const StreamTopics& topics, const Types& published) {
  const std::string &color = topics[static_cast<std::size_t>(Stream::kColor)].base,
                    &depth = topics[static_cast<std::size_t>(Stream::kDepth)].base;
  const std::size_t length = cameraLength(color, depth);
  if (length == 0) return {};
  const std::string color_name = color.substr(length), depth_name = depth.substr(length);
  std::vector<std::string> cameras;
  for (const auto& entry : published) {
    const std::size_t end = entry.first.rfind(color_name);
    if (end == std::string::npos || end == 0) continue;
    const std::string camera = entry.first.substr(0, end);
    const bool is_new = cameras.empty() || cameras.back() != camera;
    const bool fits =
        isPublished(camera + color_name, published) && isPublished(camera + depth_name, published);
    if (fits && is_new) cameras.push_back(camera);
  }
  return cameras;
}

}  // namespace

std::string adviceOn(const std::vector<StreamMonitor::Silent>& silent, const StreamTopics& topics,
                     const Types& published) {
  if (topics[static_cast<std::size_t>(Stream::kColor)].publishers == 0) {
    const std::vector<std::string> cameras = otherCameras(topics, published);
    if (!cameras.empty())
      return fmt::format("a camera with the same names is in {}: set camera:={}", fmt::join(cameras, ", "),
                         cameras.size() == 1 ? cameras.front() : " to one of these");
  }
  std::vector<std::string> sentences;
  for (const auto& [stream, unstamped] : silent) {
    const std::string& topic = topics[static_cast<std::size_t>(stream)].base;
    sentences.push_back(
        unstamped ? fmt::format("the sender of {} must set header.stamp to the time of the image", topic)
                  : streamAdvice(stream, topic, published));
  }
  return fmt::format("{}", fmt::join(sentences, "; "));
}

std::string streamAdvice(Stream stream, const std::string& topic, const Types& published) {
  const StreamWords words = wordsOf(stream);
  for (const char* transport : {"compressed", "compressedDepth"}) {
    const std::string name = topic + "/" + transport;
    if (stream != Stream::kColorInfo && published.count(topic) == 0 && published.count(name) != 0)
      return fmt::format("{} ({}) is published: set {}:={}", name, published.at(name), words.transport,
                         transport);
  }
  const std::vector<std::string> found = candidates(stream, words.type, published);
  const auto its_type = published.find(topic);
  if (its_type != published.end() && its_type->second == words.type)
    return fmt::format("{} is silent: check its driver, and ROS_IP if it runs on another machine", topic);
  const std::string wrong_type =
      its_type == published.end()
          ? ""
          : fmt::format("{} has the type {} instead of {}: ", topic, its_type->second, words.type);
  if (found.empty()) return wrong_type + words.without;
  return fmt::format("{}set {}:= to one of {}", wrong_type, words.argument, fmt::join(found, ", "));
}

}  // namespace softbody
