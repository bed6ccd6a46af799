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

/// Whether the topic is that of a transport that the tools decode.
bool isCompressed(const StreamFacts& stream) {
  return stream.type == kCompressed && stream.topic.find("/compressed") != std::string::npos;
}

/// What the user can do about a missing topic.
std::string remedy(const RecordingFacts& facts, const std::string& type) {
  std::vector<std::string> candidates = topicsOfType(facts, type);
  if (type == kImage) {
    for (const std::string& name : topicsOfType(facts, kCompressed)) candidates.push_back(name);
  }
  if (!candidates.empty()) {
    return fmt::format(
        "of that type the bag has {}; name the right one (--color, --depth, --color-info, --depth-info; of "
        "compressed images without the "
        "transport)",
        fmt::join(candidates, ", "));
  }
  return "record it";
}

void checkTopic(const RecordingFacts& facts, const StreamFacts& stream, const std::string& type,
                Severity severity, Findings* findings) {
  if (!stream.present()) {
    findings->push_back({severity, "topics", stream.topic,
                         fmt::format("is not in the bag (expected {}); {}", type, remedy(facts, type))});
  } else if (stream.type != type && !isCompressed(stream)) {
    findings->push_back(
        {severity, "types", stream.topic,
         fmt::format("is of type {} instead of {}; {}", stream.type, type, remedy(facts, type))});
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
