#include "tracker/tracking_targets.h"

namespace softbody {

std::vector<TrackedFeature> trackedFeatures(const Observation& seen, const std::vector<MapFeature>& known,
                                            const Eigen::Isometry3d& T_camera_fixed) {
  std::vector<TrackedFeature> result;
  for (const FeatureMatch& match : seen.matches) {
    if (!match.inlier) continue;
    const MapFeature& feature = known[match.feature];
    const double confidence = feature.expected_s > 0.0 ? feature.found_s / feature.expected_s : 0.0;
    result.push_back({feature.id,
                      {match.pixel.x, match.pixel.y},
                      match.association.measured,
                      T_camera_fixed * feature.reference,
                      confidence});
  }
  return result;
}

std::vector<Target> targetsOf(const std::vector<Association>& associations,
                              const Eigen::Isometry3d& T_fixed_camera) {
  std::vector<Target> targets;
  targets.reserve(associations.size());
  for (const Association& a : associations) {
    targets.push_back(
        {a.kind, a.place, T_fixed_camera * a.measured, T_fixed_camera.linear() * a.normal, a.weight});
  }
  return targets;
}

void addHeldPieces(const Observation& seen, const std::vector<std::vector<int>>& pieces,
                   const Points& simulated, const Points& found, const PositionPrior& hold,
                   std::vector<Target>* targets) {
  for (std::size_t p = 0; p < pieces.size(); ++p) {
    if (seen.visibility[p] == Visibility::kWell) continue;
    const bool almost_hidden = seen.visibility[p] == Visibility::kAlmostHidden;
    hold.addTargets(pieces[p], almost_hidden ? simulated : found, PositionPrior::kPriorWeight, targets);
  }
}

}  // namespace softbody
