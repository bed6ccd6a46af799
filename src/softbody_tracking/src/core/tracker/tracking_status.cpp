#include "tracker/tracking_status.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "alignment/piece_visibility.h"
#include "tracker/backoff.h"

namespace softbody {
namespace {

/// What an outline that is smaller or larger all around says about the mesh. Outlines that differ both ways
/// are those of another shape or pose.
std::string causeOf(const OutlineAssociations& outline, double image_scale) {
  const std::string unknown = "check mesh, scale and pose";
  if (2.0 * std::abs(outline.excess) <= outline.disagreement || !(image_scale > 0.0)) return unknown;
  if (outline.excess > 0.0) return "the image shows a larger body: check mesh and scale";
  const long smaller = std::lround(100.0 * (1.0 - image_scale));
  if (smaller <= 0) return unknown;
  return fmt::format("the image shows a body about {} % smaller: check mesh and scale", smaller);
}

/// What disagrees.
std::string sentenceFor(const Disagreement& disagreement, const std::string& cause) {
  const double error_mm = 1000.0 * disagreement.error_m;
  switch (disagreement.kind) {
    case Disagreement::Kind::kBackground:
      return fmt::format("the image shows the background at the {} part of the body, {:.0f} mm wide: {}",
                         disagreement.side, error_mm, cause);
    case Disagreement::Kind::kBehind:
      return fmt::format("depth shows the {} part of the body {:.0f} mm behind its prediction: {}",
                         disagreement.side, error_mm, cause);
    case Disagreement::Kind::kBeyond:
      break;
  }
  return fmt::format("the image shows the body {:.0f} mm beyond the {} side of its prediction: {}", error_mm,
                     disagreement.side, cause);
}

/// Whether no piece is followed.
bool isHeld(const std::vector<Visibility>& pieces) {
  const auto almostHidden = [](Visibility piece) { return piece == Visibility::kAlmostHidden; };
  return !pieces.empty() && std::all_of(pieces.begin(), pieces.end(), almostHidden);
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
                        const ShownError& error, double tolerance_m) {
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
  const std::string cause = causeOf(seen.outline, error.image_scale);
  if (error.disagreement.error_m > tolerance_m)
    status.reason = sentenceFor(error.disagreement, cause);
  else if (error.bound_m > tolerance_m)
    status.reason = fmt::format("half of the visible body may be {:.0f} mm off or more: {}",
                                1000.0 * error.bound_m, cause);
  else if (isHeld(seen.visibility))
    status.reason = "every piece is almost hidden, and stays at its last pose";
  status.state = status.reason.empty() ? TrackingState::kTracking : TrackingState::kDegraded;
  return status;
}

TrackingStatus HeldPieces::report(const Observation& seen, const std::vector<std::set<std::uint32_t>>& names,
                                  Nanoseconds stamp, TrackingStatus status) {
  since_.resize(seen.visibility.size());
  std::set<std::uint32_t> all, missing, hidden;
  for (std::size_t p = 0; p < since_.size(); ++p) {
    if (seen.visibility[p] != Visibility::kAlmostHidden)
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
    append("almost hidden, at the last pose: " + piecesText(missing, all.size()), &status.reason);
  }
  if (!hidden.empty()) {
    append(piecesText(hidden, all.size()) + " out of view or too small to be followed: only inferred",
           &status.reason);
  }
  return status;
}

}  // namespace softbody
