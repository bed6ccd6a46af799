#pragma once

#include "softbody_common/parameters.h"

namespace softbody {

/// First alignment of the rest shape with the depth image.
struct RegistrationConfig {
  /// Depth differences beyond this count as free space or occlusion, at up to 1 m; further away, where depth
  /// is noisier, beyond this times the distance.
  double distance_scale_m = 0.02;
  double max_cost = 0.5;  ///< mean cost a pixel, 0..1, above which the registration is refused
};

/// ORB features, bound to the body where they lie.
struct FeatureConfig {
  int max_features = 1000;        ///< N_p of Kang et al. 2022
  int search_radius_px = 20;      ///< around the predicted position
  int max_hamming_distance = 64;  ///< of 256 bits
  double max_disagreement_m =
      0.006;  ///< residual against the neighbours' median residual; more is an outlier
  double weight =
      0.5;  ///< of a feature target where its patch fits; up to four times that where they are few
};

/// Depth pixels as targets on the visible surface.
struct DepthConfig {
  int max_targets = 1500;
  double max_distance_m = 0.04;  ///< between prediction and measurement along the ray
  double weight = 1.0;           ///< of all depth targets on a patch of one mean tet edge squared;
                                 ///< of one at most kLargestTargetWeight
};

/// Where the body ends in the image.
struct OutlineConfig {
  double weight = 1.0;  ///< of all outline targets on the length of one mean tet edge; 0: none are made
};

/// The paper's way of making targets: vertices moved by their neighbouring features (Kang et al. 2022, eq.
/// 3-4).
struct KnnConfig {
  int max_neighbors = 10;      ///< N_k
  double radius_m = 0.01;      ///< delta_k
  bool local_rotation = true;  ///< carry the offset from feature to vertex with the local rotation
};

struct TrackerConfig {
  bool knn_targets = false;  ///< target_mode: knn instead of material
  bool use_depth = true;
  RegistrationConfig registration;
  FeatureConfig features;
  DepthConfig depth;
  OutlineConfig outline;
  KnnConfig knn;
};

/// @throw std::invalid_argument as Parameters does.
TrackerConfig readTrackerConfig(Parameters& parameters);

}  // namespace softbody
