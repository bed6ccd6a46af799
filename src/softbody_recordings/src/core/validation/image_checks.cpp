#include "validation/image_checks.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace softbody::validation {
namespace {

// The encodings that cv_bridge converts to bgr8.
const std::set<std::string> kColorEncodings{
    "rgb8", "bgr8", "rgba8", "bgra8", "yuv422", "bayer_rggb8", "bayer_bggr8", "bayer_gbrg8", "bayer_grbg8"};
const std::set<std::string> kDepthEncodings{"16UC1", "mono16", "32FC1"};

// A shift is reported from this share of the image's width on: 13 pixels of 640.
constexpr double kSmallestShift = 0.02;
constexpr double kClearSimilarity = 0.15, kClearlyBetter = 1.3;

std::string sizeText(const std::pair<int, int>& size) {
  return fmt::format("{}x{}", size.first, size.second);
}

void checkEncodings(const StreamFacts& stream, const std::set<std::string>& allowed, const char* expected,
                    Findings* findings) {
  for (const auto& [encoding, count] : stream.encodings) {
    if (allowed.count(encoding) != 0) continue;
    findings->push_back(
        {Severity::kError, "encodings", stream.topic,
         fmt::format("has {} images of encoding '{}'; convert them to {}", count, encoding, expected)});
  }
}

void checkSizes(const StreamFacts& stream, Findings* findings) {
  if (stream.sizes.size() > 1) {
    std::vector<std::string> sizes;
    for (const auto& [size, count] : stream.sizes)
      sizes.push_back(fmt::format("{} of {}", count, sizeText(size)));
    findings->push_back({Severity::kError, "sizes", stream.topic,
                         fmt::format("changes its size: {}; split the bag, or record at one resolution",
                                     fmt::join(sizes, ", "))});
  }
  if (stream.malformed > 0) {
    findings->push_back(
        {Severity::kError, "sizes", stream.topic,
         fmt::format("has {} images with a wrong number of bytes for their size and encoding; "
                     "check the driver or the conversion",
                     stream.malformed)});
  }
}

bool similar(const CameraFacts& a, const CameraFacts& b) {
  const auto near = [](double x, double y, double tolerance) { return std::abs(x - y) <= tolerance; };
  return near(a.fx, b.fx, 0.01 * a.fx) && near(a.fy, b.fy, 0.01 * a.fy) && near(a.cx, b.cx, 2.0) &&
         near(a.cy, b.cy, 2.0);
}

/// Edges of depth and colour agree clearly better with a shift that no edge is wide.
bool isShifted(const RegistrationShift& shift, const StreamFacts& color) {
  if (color.sizes.empty()) return false;
  const double width = color.sizes.begin()->first.first;
  return cv::norm(shift.pixels) > kSmallestShift * width && shift.similarity > kClearSimilarity &&
         shift.similarity > kClearlyBetter * shift.unshifted;
}

void checkRegistration(const RecordingFacts& facts, Findings* findings) {
  const StreamFacts &color = facts.color, &depth = facts.depth;
  const char remedy[] =
      "depth is not registered to colour: record the driver's aligned depth (align_depth:=true), or "
      "depth's camera_info and /tf_static, from which the tracker registers it";
  const bool placed = !facts.depth_cameras.empty() &&
                      (color.frame_ids == depth.frame_ids || facts.topics.count("/tf_static") != 0 ||
                       facts.topics.count("/tf") != 0);
  const Severity severity = placed ? Severity::kWarning : Severity::kError;
  if (color.sizes.size() == 1 && depth.sizes.size() == 1 &&
      color.sizes.begin()->first != depth.sizes.begin()->first) {
    findings->push_back({severity, "registration", depth.topic,
                         fmt::format("is {}, {} is {}; {}", sizeText(depth.sizes.begin()->first), color.topic,
                                     sizeText(color.sizes.begin()->first), remedy)});
    return;
  }
  if (!facts.color_cameras.empty() && !facts.depth_cameras.empty() &&
      !similar(facts.color_cameras.front(), facts.depth_cameras.front())) {
    const CameraFacts &a = facts.color_cameras.front(), &b = facts.depth_cameras.front();
    findings->push_back(
        {severity, "registration", facts.depth_info.topic,
         fmt::format("has fx {:.1f} cx {:.1f} cy {:.1f}, {} has fx {:.1f} cx {:.1f} cy {:.1f}; {}", b.fx,
                     b.cx, b.cy, facts.color_info.topic, a.fx, a.cx, a.cy, remedy)});
  } else if (facts.shift && isShifted(*facts.shift, color)) {
    findings->push_back(
        {Severity::kError, "registration", depth.topic,
         fmt::format(
             "has its edges {:.0f} pixels beside those of {} (right {:+.0f}, down {:+.0f}); depth is not "
             "registered, or its camera_info is of another camera: record the driver's aligned depth, and "
             "calibrate the two cameras to each other",
             cv::norm(facts.shift->pixels), color.topic, facts.shift->pixels.x, facts.shift->pixels.y)});
  } else if (!color.frame_ids.empty() && !depth.frame_ids.empty() && color.frame_ids != depth.frame_ids) {
    findings->push_back({Severity::kWarning, "frames", depth.topic,
                         fmt::format("is in frame '{}', {} is in '{}'; if depth is registered to colour, use "
                                     "the frame of colour",
                                     *depth.frame_ids.begin(), color.topic, *color.frame_ids.begin())});
  }
}

void checkFrameIds(const StreamFacts& stream, Findings* findings) {
  if (stream.frame_ids.count("") != 0) {
    findings->push_back(
        {Severity::kWarning, "frames", stream.topic,
         "has an empty frame_id, so the results have no frame; set the optical frame in the driver"});
  } else if (stream.frame_ids.size() > 1) {
    findings->push_back({Severity::kWarning, "frames", stream.topic,
                         fmt::format("changes its frame_id: {}; use one namespace for each camera",
                                     fmt::join(stream.frame_ids, ", "))});
  }
}

}  // namespace

Findings checkImages(const RecordingFacts& facts) {
  Findings findings;
  checkEncodings(facts.color, kColorEncodings, "rgb8 or bgr8", &findings);
  checkEncodings(facts.depth, kDepthEncodings, "16UC1 [mm] or 32FC1 [m]", &findings);
  for (const StreamFacts* stream : {&facts.color, &facts.depth}) {
    checkSizes(*stream, &findings);
    checkFrameIds(*stream, &findings);
  }
  checkRegistration(facts, &findings);
  return findings;
}

}  // namespace softbody::validation
