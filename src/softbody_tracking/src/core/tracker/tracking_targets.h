#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "softbody_tracking/tracker/body_tracker.h"
#include "targets/position_prior.h"
#include "tracker/frame_observer.h"

namespace softbody {

/// The features that a frame shows where they were expected. @param known FeatureMap::features().
std::vector<TrackedFeature> trackedFeatures(const Observation& seen, const std::vector<MapFeature>& known,
                                            const Eigen::Isometry3d& T_camera_fixed);

/// In the fixed frame. @param associations in the camera's.
std::vector<Target> targetsOf(const std::vector<Association>& associations,
                              const Eigen::Isometry3d& T_fixed_camera);

/// What hardly shows stays where the simulation had it: nothing tells where else it is. What shows loosely
/// goes as a whole where it was found. @param simulated vertices of the volume, fixed frame. @param found
/// the same, where they were found. @param pieces the vertices of each.
void holdUnseen(const Observation& seen, const std::vector<std::vector<int>>& pieces, const Points& simulated,
                const Points& found, const PositionPrior& hold, std::vector<Target>* targets);

}  // namespace softbody
