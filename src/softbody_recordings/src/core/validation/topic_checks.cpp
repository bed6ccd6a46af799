#include "validation/topic_checks.h"

#include <fmt/format.h>

namespace softbody::validation {
namespace {

constexpr char kImage[] = "sensor_msgs/Image", kInfo[] = "sensor_msgs/CameraInfo",
               kCompressed[] = "sensor_msgs/CompressedImage";

std::vector<std::string> topicsOfType(const RecordingFacts& facts, const std::string& type) {
  std::vector<std::string> names;
  for (const auto& [name, its_type] : facts.topics) {
    if (its_type == type) names.push_back(name);
  }
  return names;
}

/// What the user can do about a missing topic.
std::string remedy(const RecordingFacts& facts, const std::string& topic, const std::string& type) {
  if (facts.topics.count(topic + "/compressed") != 0) {
    return fmt::format(
        "there is {0}/compressed, which is not read; decompress it to {0} with image_transport's "
        "republish, or record raw images",
        topic);
  }
  const std::vector<std::string> candidates = topicsOfType(facts, type);
  if (!candidates.empty()) {
    return fmt::format(
        "of that type the bag has {}; give the camera's namespace (camera:=, --camera) or remap the topics",
        fmt::join(candidates, ", "));
  }
  const std::vector<std::string> compressed = topicsOfType(facts, kCompressed);
  if (type == kImage && !compressed.empty()) {
    return fmt::format("the bag has only compressed images ({}), which are not read; record raw images",
                       fmt::join(compressed, ", "));
  }
  return "record it";
}

void checkTopic(const RecordingFacts& facts, const StreamFacts& stream, const std::string& type,
                Severity severity, Findings* findings) {
  if (!stream.present()) {
    findings->push_back(
        {severity, "topics", stream.topic,
         fmt::format("is not in the bag (expected {}); {}", type, remedy(facts, stream.topic, type))});
  } else if (stream.type != type) {
    findings->push_back({severity, "types", stream.topic,
                         fmt::format("is of type {} instead of {}; {}", stream.type, type,
                                     remedy(facts, stream.topic, type))});
  }
}

}  // namespace

Findings checkTopics(const RecordingFacts& facts) {
  Findings findings;
  checkTopic(facts, facts.color, kImage, Severity::kError, &findings);
  checkTopic(facts, facts.color_info, kInfo, Severity::kError, &findings);
  checkTopic(facts, facts.depth, kImage, Severity::kError, &findings);
  // The tracker uses the CameraInfo of colour. The check of registration needs that of depth.
  checkTopic(facts, facts.depth_info, kInfo, Severity::kWarning, &findings);
  return findings;
}

}  // namespace softbody::validation
