#include "validation/depth_checks.h"

#include <fmt/format.h>

namespace softbody::validation {
namespace {

bool anyDepth(const RecordingFacts& facts, const char* encoding) {
  return facts.depth.encodings.count(encoding) != 0;
}

}  // namespace

Findings checkDepth(const RecordingFacts& facts, const CheckLimits& limits) {
  const DepthFacts& depth = facts.depth_values;
  if (depth.images == 0) return {};
  if (depth.valid_share == 0.0) {
    return {
        {Severity::kError, "depth", facts.depth.topic,
         fmt::format(
             "is zero everywhere in {} sampled images; uncover the camera, and keep the object beyond its "
             "smallest distance",
             depth.images)}};
  }
  Findings findings;
  const bool millimetres = !anyDepth(facts, "32FC1");
  const double metres = millimetres ? 1e-3 * depth.median : depth.median;
  if (metres < limits.nearest_m || metres > limits.farthest_m) {
    findings.push_back(
        {Severity::kError, "depth scale", facts.depth.topic,
         fmt::format(
             "has a median depth of {:.4g} as {}, that is {:.4g} m; {} must be in {}; scale the images",
             depth.median, millimetres ? "16UC1" : "32FC1", metres, millimetres ? "16UC1" : "32FC1",
             millimetres ? "millimetres" : "metres")});
  } else if (metres > limits.usual_farthest_m) {
    findings.push_back(
        {Severity::kWarning, "depth scale", facts.depth.topic,
         fmt::format("has a median depth of {:.2f} m; if the scene is nearer, the unit is not the {} of "
                     "the encoding",
                     metres, millimetres ? "millimetre" : "metre")});
  }
  if (depth.valid_share < limits.smallest_valid_share) {
    findings.push_back(
        {Severity::kWarning, "depth", facts.depth.topic,
         fmt::format("has a depth at only {:.0f} % of the pixels; light the scene, switch on the emitter, or "
                     "move the camera to 0.3-1 m",
                     100.0 * depth.valid_share)});
  }
  return findings;
}

}  // namespace softbody::validation
