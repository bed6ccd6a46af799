#include "validation/image_checks.h"

#include <fmt/format.h>

namespace softbody::validation {
namespace {

// A shift is reported from this share of the image's width on: 13 pixels of 640.
constexpr double kSmallestShift = 0.02;
constexpr double kClearSimilarity = 0.15, kClearlyBetter = 1.3;

std::string sizeText(const std::pair<int, int>& size) {
  return fmt::format("{}x{}", size.first, size.second);
}

void checkSizes(const StreamFacts& stream, Findings* findings) {
  if (stream.sizes.size() < 2) return;
  std::vector<std::string> sizes;
  for (const auto& [size, count] : stream.sizes)
    sizes.push_back(fmt::format("{} of {}", count, sizeText(size)));
  findings->push_back({Severity::kWarning, "sizes", stream.topic,
                       fmt::format("changes its size: {}; split the bag, or record at one resolution",
                                   fmt::join(sizes, ", "))});
}

/// Edges of depth and colour agree clearly better with a shift that no edge is wide.
bool isShifted(const RegistrationShift& shift, const StreamFacts& color) {
  if (color.sizes.empty()) return false;
  const double width = color.sizes.begin()->first.first;
  return cv::norm(shift.pixels) > kSmallestShift * width && shift.similarity > kClearSimilarity &&
         shift.similarity > kClearlyBetter * shift.unshifted;
}

void checkRegistration(const RecordingFacts& facts, Findings* findings) {
  if (!facts.shift || !isShifted(*facts.shift, facts.color)) return;
  const char* const cause = facts.depth_cameras.empty()
                                ? "depth is not registered, or its camera_info is of another camera: record "
                                  "the driver's aligned depth, "
                                  "and calibrate the two cameras to each other"
                                : "the two camera_infos, or the transform between the two cameras on "
                                  "/tf_static, are wrong: calibrate "
                                  "the two cameras to each other, or record the driver's aligned depth";
  findings->push_back(
      {Severity::kError, "registration", facts.depth.topic,
       fmt::format("has its edges {:.0f} pixels beside those of {} (right {:+.0f}, down {:+.0f}); {}",
                   cv::norm(facts.shift->pixels), facts.color.topic, facts.shift->pixels.x,
                   facts.shift->pixels.y, cause)});
}

/// @param several severity of several frames: the result is in colour's.
void checkFrameIds(const StreamFacts& stream, Severity several, Findings* findings) {
  if (stream.frame_ids.count("") != 0) {
    findings->push_back(
        {Severity::kWarning, "frames", stream.topic,
         "has an empty frame_id, so the results have no frame; set the optical frame in the driver"});
  }
  if (stream.frame_ids.size() > 1) {
    findings->push_back({several, "frames", stream.topic,
                         fmt::format("changes its frame_id: '{}'; use one namespace for each camera",
                                     fmt::join(stream.frame_ids, "', '"))});
  }
}

}  // namespace

Findings checkImages(const RecordingFacts& facts) {
  Findings findings;
  for (const StreamFacts* stream : {&facts.color, &facts.depth}) checkSizes(*stream, &findings);
  checkFrameIds(facts.color, Severity::kError, &findings);
  checkFrameIds(facts.depth, Severity::kWarning, &findings);
  checkRegistration(facts, &findings);
  return findings;
}

}  // namespace softbody::validation
