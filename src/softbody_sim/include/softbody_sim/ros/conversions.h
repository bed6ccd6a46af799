#pragma once

#include <visualization_msgs/Marker.h>

#include "softbody_common/types.h"

/// Between the core's structs and messages, beyond softbody_common/conversions.h. Headers are the caller's.
namespace softbody {

/// Opaque. @param rgb 0 to 1.
std_msgs::ColorRGBA colorMessage(const Eigen::Vector3f& rgb);

/// The mesh as a TRIANGLE_LIST, shaded as by a lamp at the frame's origin (rviz does not light coloured
/// triangles): warm where it was observed, paler where it is inferred.
/// @throw std::invalid_argument if the state is not of the topology's revision and size.
visualization_msgs::Marker makeSurfaceMarker(const MeshTopology& topology, const MeshState& state);

}  // namespace softbody
