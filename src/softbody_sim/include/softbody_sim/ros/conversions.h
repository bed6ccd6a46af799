#pragma once

#include <softbody_msgs/Pin.h>
#include <softbody_msgs/PinRegion.h>
#include <softbody_msgs/SetObstacle.h>
#include <visualization_msgs/Marker.h>

#include "softbody_common/geometry/types.h"
#include "softbody_sim/constraints/obstacle_description.h"
#include "softbody_sim/object/pin_region.h"

/// Conversions between the core's structs and messages. The caller sets the headers.
namespace softbody {

/// The box may be infinite. @throw std::invalid_argument if the name cannot be part of a topic name, a number
/// is missing (NaN), or the box is inside out.
PinRegion fromMessage(const softbody_msgs::PinRegion& message);
PinRegion fromMessage(const softbody_msgs::PinRequest& request);

/// @param request with a shape. @throw std::invalid_argument as readObstacle does.
ObstacleDescription fromMessage(const softbody_msgs::SetObstacleRequest& request);

/// Opaque. @param rgb 0 to 1.
std_msgs::ColorRGBA colorMessage(const Eigen::Vector3f& rgb);

/// The mesh as a TRIANGLE_LIST: orange where it was observed, grey where it is inferred. Colours include the
/// light of a lamp at the frame's origin, because rviz does not light coloured triangles.
/// @throw std::invalid_argument if revision or size of state and topology differ.
visualization_msgs::Marker makeSurfaceMarker(const MeshTopology& topology, const MeshState& state);

}  // namespace softbody
