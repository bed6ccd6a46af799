#include "softbody_tracking/tracker_config.h"

#include <stdexcept>
#include <string>

#include "softbody_common/target_limits.h"

namespace softbody {
namespace {

// Fewest max_features for target_mode knn; with fewer, most vertices would have no feature within the radius.
constexpr int kFewestKnnFeatures = 50;

RegistrationConfig readRegistrationConfig(Parameters& parameters) {
  RegistrationConfig registration;
  registration.distance_scale_m =
      parameters.number("registration_distance_scale_m", registration.distance_scale_m, 0.001, 1.0);
  registration.max_cost = parameters.number("registration_max_cost", registration.max_cost, 0.01, 0.9);
  registration.anywhere = parameters.choice("search", "given", {"given", "anywhere"}) == "anywhere";
  registration.pose_std_m = parameters.number("initial_pose_std_m", registration.pose_std_m, 0.001, 10.0);
  registration.pose_std_deg =
      parameters.number("initial_pose_std_deg", registration.pose_std_deg, 0.1, 180.0);
  return registration;
}

KnnConfig readKnnConfig(Parameters& parameters) {
  KnnConfig knn;
  knn.max_neighbors = parameters.integer("max_neighbors", knn.max_neighbors, 1, 1000);
  knn.radius_m = parameters.number("neighbor_radius_m", knn.radius_m, 1e-4, 10.0);
  knn.local_rotation = parameters.flag("neighbor_local_rotation", knn.local_rotation);
  return knn;
}

}  // namespace

TrackerConfig readTrackerConfig(Parameters& parameters) {
  TrackerConfig config;
  config.knn_targets = parameters.choice("target_mode", "material", {"material", "knn"}) == "knn";
  config.use_depth = parameters.flag("depth_targets", config.use_depth);

  config.registration = readRegistrationConfig(parameters);

  FeatureConfig& features = config.features;
  features.between_frames =
      parameters.choice("feature_matching", "patches", {"patches", "frames"}) == "frames";
  features.max_features = parameters.integer("max_features", features.max_features, 0, 20000);
  features.search_radius_px =
      parameters.integer("feature_search_radius_px", features.search_radius_px, 1, 200);
  features.max_hamming_distance =
      parameters.integer("feature_max_hamming_distance", features.max_hamming_distance, 0, 256);
  features.max_disagreement_m =
      parameters.number("feature_max_disagreement_m", features.max_disagreement_m, 1e-4, 1.0);
  features.weight = parameters.number("feature_weight", features.weight, 1e-6, kLargestTargetWeight);

  DepthConfig& depth = config.depth;
  depth.max_targets = parameters.integer("max_depth_targets", depth.max_targets, 100, 100000);
  depth.max_distance_m = parameters.number("depth_max_distance_m", depth.max_distance_m, 1e-3, 1.0);
  depth.weight = parameters.number("depth_weight", depth.weight, 1e-6, kLargestTargetWeight);

  config.outline.weight =
      parameters.number("outline_weight", config.outline.weight, 0.0, kLargestTargetWeight);

  config.status.tolerance_m = parameters.number("status_tolerance_m", config.status.tolerance_m, 1e-4, 1.0);

  if (config.knn_targets && features.max_features < kFewestKnnFeatures) {
    throw std::invalid_argument("parameter max_features must be at least " +
                                std::to_string(kFewestKnnFeatures) + " for target_mode knn");
  }
  config.knn = readKnnConfig(parameters);
  return config;
}

}  // namespace softbody
