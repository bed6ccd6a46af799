#include "timing/status_words.h"

#include <fmt/format.h>

namespace softbody {

std::string sentenceOf(TrackingState state) {
  switch (state) {
    case TrackingState::kInitializing:
      return "Looking for the body";
    case TrackingState::kTracking:
      return "Tracking";
    case TrackingState::kDegraded:
      return "Tracking, but the body is badly seen";
    case TrackingState::kLost:
      return "Lost";
    case TrackingState::kRecovering:
      return "Lost: searching the whole image";
  }
  return "Unknown state";
}

std::string numbersOf(const TrackingStatus& status) {
  return fmt::format("{} of {} features, {:.0f} % inliers, residual {:.1f} mm", status.features_tracked,
                     status.features_total, 100.0 * status.inlier_ratio, 1000.0 * status.residual_rms);
}

}  // namespace softbody
