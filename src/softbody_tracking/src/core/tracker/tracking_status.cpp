#include "tracker/tracking_status.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "alignment/piece_observability.h"
#include "tracker/backoff.h"

namespace softbody {
namespace {

// Share of the visible surface that must agree in depth; with less, most of the body is not measured.
constexpr double kDegradedShare = 0.3;
// Largest area between the outlines of image and mesh, as a share of the body's. Right meshes stay below
// 0.15, thin and fast ones too; wrong ones are above 0.27.
constexpr double kLargestDisagreement = 0.18;
// Share of the expected features that must be found; with fewer, something covers them or the light changed.
constexpr double kFewestTracked = 0.05;
// Smallest share of inliers among the matches.
constexpr double kWorstInlierRatio = 0.2;

/// What an outline that is smaller or larger all around says about the mesh. Outlines that differ both ways
/// are those of another shape or pose.
std::string causeOf(const OutlineAssociations& outline, double image_scale) {
  if (2.0 * std::abs(outline.excess) <= outline.disagreement || !(image_scale > 0.0))
    return "check mesh, scale and pose";
  if (outline.excess > 0.0) return "the image shows a larger body: check mesh and scale";
  return fmt::format("the image shows a body about {:.1f} times smaller: check mesh and scale",
                     1.0 / image_scale);
}

/// Reason for a degraded state; empty if the frame shows the body well.
std::string whyDegraded(const Observation& seen, int kept, const std::optional<LocalMismatch>& mismatch,
                        double image_scale) {
  const auto explained = static_cast<double>(seen.agreeing_blocks);
  if (explained < kDegradedShare * seen.depth.visible_blocks) {
    return seen.depth.occluded_blocks > seen.depth.absent_blocks ? "most of the body is occluded"
                                                                 : "most of the body is not where predicted";
  }
  if (seen.outline.disagreement > kLargestDisagreement) {
    return fmt::format("the outlines of image and mesh differ by {:.0f} % of the body's area: {}",
                       100.0 * seen.outline.disagreement, causeOf(seen.outline, image_scale));
  }
  if (mismatch) {
    return fmt::format("the {} part of the body in the image is at least {:.0f} mm off its prediction: {}",
                       mismatch->side, 1000.0 * mismatch->width_m, causeOf(seen.outline, image_scale));
  }
  if (seen.expected_features >= kFewestExpectedFeatures && kept < kFewestTracked * seen.expected_features)
    return "hardly any of the expected features are found";
  if (seen.matched_features >= kFewestExpectedFeatures && kept < kWorstInlierRatio * seen.matched_features)
    return "most feature matches disagree with their neighbours";
  return {};
}

std::string piecesText(const std::set<std::uint32_t>& numbers, std::size_t count) {
  return fmt::format("{} {} of {} (triangle_bodies, from 0)", numbers.size() == 1 ? "piece" : "pieces",
                     fmt::join(numbers, ", "), count);
}

void append(const std::string& text, std::string* reason) {
  if (!reason->empty()) *reason += "; ";
  *reason += text;
}

}  // namespace

TrackingStatus statusOf(const Observation& seen, const std::vector<Association>& associations,
                        const std::optional<LocalMismatch>& mismatch, double image_scale) {
  TrackingStatus status;
  const auto kept = static_cast<int>(std::count_if(seen.matches.begin(), seen.matches.end(),
                                                   [](const FeatureMatch& match) { return match.inlier; }));
  status.features_tracked = static_cast<std::uint32_t>(kept);
  status.inlier_ratio = seen.matched_features == 0 ? 0.0 : static_cast<double>(kept) / seen.matched_features;
  status.residual_rms = rmsResidual(associations);
  if (static_cast<int>(seen.agreeing_blocks) + kept < kFewestAssociations) {
    status.state = TrackingState::kLost;
    status.reason = seen.depth.visible_blocks == 0 ? "the body is out of view or nothing is measured there"
                                                   : "neither depth nor features agree with the prediction";
    return status;
  }
  status.reason = whyDegraded(seen, kept, mismatch, image_scale);
  status.state = status.reason.empty() ? TrackingState::kTracking : TrackingState::kDegraded;
  return status;
}

TrackingStatus HeldPieces::report(const Observation& seen, const std::vector<std::set<std::uint32_t>>& names,
                                  Nanoseconds stamp, TrackingStatus status) {
  since_.resize(seen.observability.size());
  std::set<std::uint32_t> all, missing, hidden;
  for (std::size_t p = 0; p < since_.size(); ++p) {
    if (seen.observability[p] != Observability::kPoor)
      since_[p].reset();
    else if (!since_[p])
      since_[p] = stamp;
    all.insert(names[p].begin(), names[p].end());
    if (!since_[p] || stamp - *since_[p] < kLongestGap) continue;
    (seen.in_view[p] ? missing : hidden).insert(names[p].begin(), names[p].end());
  }
  if (status.state != TrackingState::kTracking) return status;
  if (!missing.empty()) {
    status.state = TrackingState::kDegraded;
    append("too little shows of " + piecesText(missing, all.size()) + ": held where it was", &status.reason);
  }
  if (!hidden.empty()) {
    append(piecesText(hidden, all.size()) + " out of view or too small to be followed: only inferred",
           &status.reason);
  }
  return status;
}

}  // namespace softbody
