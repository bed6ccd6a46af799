#include "validation/depth_checks.h"

#include <fmt/format.h>

#include "softbody_common/protocol/camera_topics.h"

namespace softbody::validation {
namespace {

// Fewer pixels than this show no body that could be found: 300 of 640x480.
constexpr double kFewestUsable = 1e-3;

/// A unit that brings the median to where bodies are tracked, the coarsest first; 0: none.
double unitFor(double median) {
  for (const double unit_m : kDepthUnits_m)
    if (unit_m * median >= 0.2 && unit_m * median <= 2.0) return unit_m;
  return 0.0;
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
  const double metres = depth.unit_m * depth.median;
  if (depth.usable_share < kFewestUsable) {
    const double unit_m = unitFor(depth.median);
    findings.push_back(
        {Severity::kError, "depth scale", facts.depth.topic,
         fmt::format("has a median depth of {:.4g}, that is {:.4g} m, and almost none from {} to {} m; {}",
                     depth.median, metres, limits.nearest_m, limits.farthest_m,
                     unit_m > 0.0 ? fmt::format("if its unit is {} m, set depth_scale (--depth-scale {})",
                                                unit_m, unit_m)
                                  : "set depth_scale to the metres of one unit")});
  } else if (metres > limits.usual_farthest_m) {
    findings.push_back(
        {Severity::kWarning, "depth scale", facts.depth.topic,
         fmt::format("has a median depth of {:.2f} m; if the scene is nearer, set depth_scale to "
                     "the metres of one unit",
                     metres)});
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
