#include "softbody_tracking/tracker_config.h"

#include "softbody_common/protocol/target_limits.h"

namespace softbody {
namespace {

ParameterTable<RegistrationConfig> registrationTable() {
  using Config = RegistrationConfig;
  ParameterTable<Config> table;
  table.group("registration");
  table.choice<bool>("search", &Config::anywhere, {{"given", false}, {"anywhere", true}},
                     "given: a body with a rough pose is searched for only there; anywhere: elsewhere, too");
  table.number("initial_pose_std_m", &Config::pose_std_m, {0.001, 10.0}, "m",
               "standard deviation of the rough pose's place, along each axis");
  table.number("initial_pose_std_deg", &Config::pose_std_deg, {0.1, 180.0}, "degrees",
               "standard deviation of the rough pose's turn");
  return table;
}

ParameterTable<TrackerConfig> makeTrackerTable() {
  using Config = TrackerConfig;
  ParameterTable<Config> table;
  table.group("depth");
  table.number("max_depth_targets", &Config::max_depth_targets, {100, 100000}, "",
               "largest number of blocks. More: smaller pieces can be followed; fewer: faster",
               Change::kLive);
  table.number("depth_weight", &Config::depth_weight, {1e-6, kLargestTargetWeight}, "",
               "total weight of the depth targets on an area of e^2. Less for a camera with wrong depth",
               Change::kLive);
  table.number("outline_weight", &Config::outline_weight, {0.0, kLargestTargetWeight}, "",
               "total weight of the outline targets on a length e of the outline, if their standard "
               "deviation is 1 mm; 0: none, for a mesh whose outline is not exact",
               Change::kLive);
  table.number("status_tolerance_m", &Config::status_tolerance_m, {1e-4, 1.0}, "m",
               "TRACKING while the body is not seen farther from its prediction, see [status](#status): "
               "what your use of the mesh allows",
               Change::kLive);
  table.part(&Config::registration, registrationTable());
  table.group("features");
  table.number("max_features", &Config::max_features, {0, 20000}, "",
               "largest number of features in view (N_p in the paper); fewer: faster", Change::kLive);
  return table;
}

}  // namespace

const ParameterTable<TrackerConfig>& trackerParameters() {
  static const ParameterTable<TrackerConfig> table = makeTrackerTable();
  return table;
}

}  // namespace softbody
