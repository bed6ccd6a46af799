#pragma once

#include "softbody_common/parameters/parameter_table.h"

namespace softbody {

/// The search for the body in a frame, without a prediction.
struct RegistrationConfig {
  /// Larger depth differences count as free space or occlusion [m]. Beyond a distance of 1 m the value is
  /// multiplied by the square of the distance in metres, because depth is noisier there.
  double distance_scale_m = 0.02;
  double max_cost = 0.22;      ///< mean cost of a pixel, 0..1, above which a pose is rejected
  bool anywhere = false;       ///< also elsewhere, if the body is not at its rough pose
  double pose_std_m = 0.03;    ///< standard deviation of a rough pose's place along each axis
  double pose_std_deg = 15.0;  ///< of its turn
};

/// ORB features bound to the body.
struct FeatureConfig {
  bool between_frames = false;        ///< feature_matching: frames instead of patches
  int max_features = 1000;            ///< N_p of Kang et al. 2022
  int search_radius_px = 20;          ///< around the predicted pixel
  int max_hamming_distance = 64;      ///< of 256 bits
  double max_disagreement_m = 0.006;  ///< from the motion of the neighbours; more is an outlier
  double weight = 0.5;                ///< of a feature target whose patch fits
};

/// Depth pixels as targets on the visible surface.
struct DepthConfig {
  int max_targets = 1500;
  double max_distance_m = 0.04;  ///< between prediction and measurement along the ray
  double weight = 1.0;           ///< total of the depth targets on an area of one mean tet edge squared;
                                 ///< a single target has at most kLargestTargetWeight
};

/// Targets at the body's outline in the image.
struct OutlineConfig {
  double weight = 1.0;  ///< total of the outline targets on a length of one mean tet edge; 0: no targets
};

/// Targets as in the paper: neighbouring features move the vertices (Kang et al. 2022, eq. 3-4).
struct KnnConfig {
  int max_neighbors = 10;      ///< N_k
  double radius_m = 0.01;      ///< delta_k
  bool local_rotation = true;  ///< rotate the offset from feature to vertex with the body
};

/// When the body counts as tracked.
struct StatusConfig {
  double tolerance_m = 0.009;  ///< largest distance of a patch of the body from where the frames show it
};

struct TrackerConfig {
  bool knn_targets = false;  ///< target_mode: knn instead of material
  bool use_depth = true;
  RegistrationConfig registration;
  FeatureConfig features;
  DepthConfig depth;
  OutlineConfig outline;
  KnnConfig knn;
  StatusConfig status;
};

const ParameterTable<TrackerConfig>& trackerParameters();

}  // namespace softbody
