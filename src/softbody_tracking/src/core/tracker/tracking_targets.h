#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "features/map_feature.h"
#include "softbody_tracking/tracker/tracking_result.h"
#include "tracker/observation.h"

namespace softbody {

/// The inliers of a frame, with the known properties of their features. @param known FeatureMap::features().
std::vector<TrackedFeature> trackedFeatures(const Observation& seen, const std::vector<MapFeature>& known,
                                            const Eigen::Isometry3d& T_camera_fixed);

/// Targets in the fixed frame. @param associations in the camera frame.
std::vector<Target> targetsOf(const std::vector<Association>& associations,
                              const Eigen::Isometry3d& T_fixed_camera);

/// Each vertex of the volume as a material point: one of its tets and the weight 1 at its corner.
std::vector<MaterialPoint> vertexPlaces(const TetTopology& volume);

/// Adds weak targets at the vertices of pieces that are not well visible. A piece that is almost hidden
/// stays at its simulated place. A piece that is partly visible moves as a whole to the place where it
/// was found.
/// @param pieces vertices of each piece. @param simulated vertices of the volume, fixed frame [m]. @param
/// found the same after the rigid alignment. @param places vertexPlaces().
void addHeldPieces(const Observation& seen, const std::vector<std::vector<int>>& pieces,
                   const Points& simulated, const Points& found, const std::vector<MaterialPoint>& places,
                   std::vector<Target>* targets);

}  // namespace softbody
