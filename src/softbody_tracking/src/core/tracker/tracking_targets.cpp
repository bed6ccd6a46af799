#include "tracker/tracking_targets.h"

namespace softbody {
namespace {

// Weight of a target that holds a vertex: far stiffer than its inertia and far softer than any measurement,
// whose weight is about 1. It does not make the vertex observed.
constexpr double kPriorWeight = 0.01;

}  // namespace

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

std::vector<MaterialPoint> vertexPlaces(const TetTopology& volume) {
  std::vector<MaterialPoint> places(static_cast<std::size_t>(volume.rest_vertices.rows()));
  for (Eigen::Index t = 0; t < volume.tets.rows(); ++t) {
    for (int k = 0; k < 4; ++k)
      places[static_cast<std::size_t>(volume.tets(t, k))] = {static_cast<int>(t), Eigen::Vector4d::Unit(k)};
  }
  return places;
}

void addHeldPieces(const Observation& seen, const std::vector<std::vector<int>>& pieces,
                   const Points& simulated, const Points& found, const std::vector<MaterialPoint>& places,
                   std::vector<Target>* targets) {
  for (std::size_t p = 0; p < pieces.size(); ++p) {
    if (seen.visibility[p] == Visibility::kWell) continue;
    const bool almost_hidden = seen.visibility[p] == Visibility::kAlmostHidden;
    for (const int v : pieces[p]) {
      const Eigen::Vector3d position = (almost_hidden ? simulated : found).row(v);
      targets->push_back({TargetKind::kPrior, places[static_cast<std::size_t>(v)], position,
                          Eigen::Vector3d::Zero(), kPriorWeight});
    }
  }
}

}  // namespace softbody
