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
                Findings* findings) {
  if (!stream.present()) {
    findings->push_back({Severity::kError, "topics", stream.topic,
                         fmt::format("is not in the bag (expected {}); {}", type, remedy(facts, type))});
  } else if (!stream.type_fault.empty()) {
    const bool other = stream.type != type;
    findings->push_back({Severity::kError, "types", stream.topic,
                         stream.type_fault + (other ? "; " + remedy(facts, type) : "")});
  }
}

}  // namespace

Findings checkTopics(const RecordingFacts& facts) {
  Findings findings;
  checkTopic(facts, facts.color, kImage, &findings);
  checkTopic(facts, facts.color_info, kInfo, &findings);
  checkTopic(facts, facts.depth, kImage, &findings);
  // Depth that is registered to colour needs no CameraInfo; without it other depth makes no frame.
  if (facts.depth_info.present()) checkTopic(facts, facts.depth_info, kInfo, &findings);
  return findings;
}

}  // namespace softbody::validation
