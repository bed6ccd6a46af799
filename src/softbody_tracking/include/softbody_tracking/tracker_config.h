#pragma once

#include "softbody_common/parameters/parameter_table.h"

namespace softbody {

/// The search for the body in a frame, without a prediction.
struct RegistrationConfig {
  bool anywhere = false;       ///< also elsewhere, if the body is not at its rough pose
  double pose_std_m = 0.03;    ///< standard deviation of a rough pose's place along each axis
  double pose_std_deg = 15.0;  ///< of its turn
};

struct TrackerConfig {
  RegistrationConfig registration;
  int max_features = 1000;  ///< in view
  int max_depth_targets = 1500;
  /// Total of the depth targets on an area of one mean tet edge squared; a single target has at most
  /// kLargestTargetWeight.
  double depth_weight = 1.0;
  /// Total of the outline targets on a length of one mean tet edge; 0: no targets.
  double outline_weight = 1.0;
  /// The body counts as tracked while no patch of it is farther than this from where the frames show it [m].
  double status_tolerance_m = 0.009;
};

const ParameterTable<TrackerConfig>& trackerParameters();

}  // namespace softbody
