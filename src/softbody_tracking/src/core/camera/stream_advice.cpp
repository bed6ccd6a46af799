#include "softbody_tracking/camera/stream_advice.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <vector>

namespace softbody {
namespace {

using Types = std::map<std::string, std::string>;

constexpr char kImage[] = "sensor_msgs/Image", kCompressed[] = "sensor_msgs/CompressedImage",
               kInfo[] = "sensor_msgs/CameraInfo";
constexpr std::size_t kMostNamed = 6;  // topics; a longer list does not help the reader of the message

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
    if (wanted && fits(stream, topic) && found.size() < kMostNamed)
      found.push_back(fmt::format("{} ({})", topic, its_type));
  }
  return found;
}

}  // namespace

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
