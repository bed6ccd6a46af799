#include "registration/feature_confirmation.h"

#include <algorithm>

namespace softbody {
namespace {

// Smallest share of features at the body's true pose. Light or deformation hides many of them; a wrong pose
// shows hardly any.
constexpr double kSmallestFeatureShare = 0.15;

}  // namespace

bool confirms(double feature_share) { return feature_share >= kSmallestFeatureShare; }

std::optional<FoundPose> confirmedPose(const AlikePoses& alike) {
  const auto most = std::max_element(alike.shares.begin(), alike.shares.end());
  if (!confirms(*most)) return std::nullopt;
  return FoundPose{alike.poses[static_cast<std::size_t>(most - alike.shares.begin())], 1};
}

std::optional<FoundPose> undecidedPose(const AlikePoses& alike) {
  const auto unknown = [](double share) { return share < 0.0; };
  const auto first = std::find_if(alike.shares.begin(), alike.shares.end(), unknown);
  if (first == alike.shares.end()) return std::nullopt;
  return FoundPose{alike.poses[static_cast<std::size_t>(first - alike.shares.begin())],
                   static_cast<int>(std::count_if(first, alike.shares.end(), unknown))};
}

}  // namespace softbody
