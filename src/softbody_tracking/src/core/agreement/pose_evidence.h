#pragma once

#include <Eigen/Geometry>

#include "softbody_common/types.h"
#include "softbody_tracking/rgbd_frame.h"
#include "softbody_tracking/tracker_config.h"

namespace softbody {

/// How much the frame keeps the mesh from sliding in the image: by how much its PoseCost rises if it is
/// shifted or turned there, divided by how much that of a body rises that stands free. Of all motions the
/// smallest share; 1: the body stands free; 0: the mesh may slide, as on a table.
struct Confinement {
  double both_ways = 0.0;  ///< mean of a motion and its opposite: a half if one of two ends is hidden or
                           ///< touches something that continues its surface
  double each_way = 0.0;   ///< of each motion alone: near 0 then
};

Confinement confinementOf(const RgbdFrame& frame, const TriangleMesh& mesh, const Eigen::Isometry3d& pose,
                          double distance_scale_m);

/// Least Confinement of a pose that is accepted: less than half of what a body
/// has of which one of two ends is hidden.
/// At a place that is expected it counts both ways; elsewhere each way, because edges of other things are
/// everywhere.
constexpr double kLeastConfinement = 0.2;

/// Whether the frame shows the body at a pose where it is expected: what nothing hides agrees, and the pose
/// is confined.
/// @param config `max_cost` is the largest mean cost of the pixels that nothing hides, see PoseAgreement.
bool isShown(const RgbdFrame& frame, const TriangleMesh& mesh, const Eigen::Isometry3d& pose,
             const RegistrationConfig& config);

}  // namespace softbody
