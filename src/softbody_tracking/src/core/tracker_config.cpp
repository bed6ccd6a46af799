#include "softbody_tracking/tracker_config.h"

#include <stdexcept>
#include <string>

#include "softbody_common/protocol/target_limits.h"

namespace softbody {
namespace {

// Fewest max_features for target_mode knn; with fewer, most vertices would have no feature within the radius.
constexpr int kFewestKnnFeatures = 50;

void requireEnoughFeatures(const TrackerConfig& config) {
  if (!config.knn_targets || config.features.max_features >= kFewestKnnFeatures) return;
  throw std::invalid_argument("parameter max_features must be at least " +
                              std::to_string(kFewestKnnFeatures) + " for target_mode knn");
}

ParameterTable<RegistrationConfig> registrationTable() {
  using Config = RegistrationConfig;
  ParameterTable<Config> table;
  table.group("registration");
  table.number("registration_distance_scale_m", &Config::distance_scale_m, {0.001, 1.0}, "m",
               "s above, at up to 1 m distance");
  table.number("registration_max_cost", &Config::max_cost, {0.01, 0.9}, "",
               "a pose with a larger cost is refused; near a rough pose only the pixels that nothing hides "
               "count");
  table.choice<bool>("search", &Config::anywhere, {{"given", false}, {"anywhere", true}},
                     "given: a body with a rough pose is searched for only there; anywhere: elsewhere, too");
  table.number("initial_pose_std_m", &Config::pose_std_m, {0.001, 10.0}, "m",
               "standard deviation of the rough pose's place, along each axis");
  table.number("initial_pose_std_deg", &Config::pose_std_deg, {0.1, 180.0}, "degrees",
               "standard deviation of the rough pose's turn");
  return table;
}

ParameterTable<FeatureConfig> featureTable() {
  using Config = FeatureConfig;
  ParameterTable<Config> table;
  table.group("features");
  table.choice<bool>("feature_matching", &Config::between_frames, {{"patches", false}, {"frames", true}},
                     "see [tracking](#tracking)");
  table.number("max_features", &Config::max_features, {0, 20000}, "",
               "largest number of features in view (N_p in the paper); with `target_mode: knn` at least 50",
               Change::kLive);
  table.number("feature_search_radius_px", &Config::search_radius_px, {1, 200}, "px",
               "radius of the search around the predicted position", Change::kLive);
  table.number("feature_max_hamming_distance", &Config::max_hamming_distance, {0, 256}, "of 256 bits",
               "largest distance of matching descriptors", Change::kLive);
  table.number("feature_max_disagreement_m", &Config::max_disagreement_m, {1e-4, 1.0}, "m",
               "a match that differs more from its neighbours is an outlier", Change::kLive);
  table.number("feature_weight", &Config::weight, {1e-6, kLargestTargetWeight}, "",
               "weight of a feature target; with `target_mode: knn` only used in the rigid step",
               Change::kLive);
  return table;
}

ParameterTable<DepthConfig> depthTable() {
  using Config = DepthConfig;
  ParameterTable<Config> table;
  table.group("depth");
  table.number("max_depth_targets", &Config::max_targets, {100, 100000}, "",
               "largest number of blocks. With more blocks, smaller pieces can be followed", Change::kLive);
  table.number("depth_max_distance_m", &Config::max_distance_m, {1e-3, 1.0}, "m",
               "largest difference along the ray", Change::kLive);
  table.number("depth_weight", &Config::weight, {1e-6, kLargestTargetWeight}, "",
               "total weight of the depth targets on an area of e^2", Change::kLive);
  return table;
}

ParameterTable<OutlineConfig> outlineTable() {
  ParameterTable<OutlineConfig> table;
  table.group("depth");
  table.number("outline_weight", &OutlineConfig::weight, {0.0, kLargestTargetWeight}, "",
               "total weight of the outline targets on a length e of the outline, if their standard "
               "deviation is 1 mm; 0: none",
               Change::kLive);
  return table;
}

ParameterTable<StatusConfig> statusTable() {
  ParameterTable<StatusConfig> table;
  table.group("depth");
  table.number("status_tolerance_m", &StatusConfig::tolerance_m, {1e-4, 1.0}, "m",
               "TRACKING while the body is not seen farther from its prediction, see [status](#status)",
               Change::kLive);
  return table;
}

ParameterTable<KnnConfig> knnTable() {
  using Config = KnnConfig;
  ParameterTable<Config> table;
  table.group("targets");
  table.number("max_neighbors", &Config::max_neighbors, {1, 1000}, "", "knn: N_k");
  table.number("neighbor_radius_m", &Config::radius_m, {1e-4, 10.0}, "m", "knn: delta_k");
  table.flag("neighbor_local_rotation", &Config::local_rotation,
             "knn: rotate the offset with the local rotation; false: as in the paper");
  return table;
}

ParameterTable<TrackerConfig> makeTrackerTable() {
  using Config = TrackerConfig;
  ParameterTable<Config> table;
  table.group("targets");
  table.choice<bool>("target_mode", &Config::knn_targets, {{"material", false}, {"knn", true}}, "see above");
  table.part(&Config::knn, knnTable());
  table.group("depth");
  table.flag("depth_targets", &Config::use_depth, "use depth on the visible surface, and the outline");
  table.part(&Config::depth, depthTable());
  table.part(&Config::outline, outlineTable());
  table.part(&Config::status, statusTable());
  table.part(&Config::registration, registrationTable());
  table.part(&Config::features, featureTable());
  table.check(requireEnoughFeatures);
  return table;
}

}  // namespace

const ParameterTable<TrackerConfig>& trackerParameters() {
  static const ParameterTable<TrackerConfig> table = makeTrackerTable();
  return table;
}

}  // namespace softbody
