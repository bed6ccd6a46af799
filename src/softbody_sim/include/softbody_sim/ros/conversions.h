#pragma once

#include <visualization_msgs/Marker.h>

#include "softbody_common/types.h"

/// Conversions from the core's structs to messages. The caller sets the headers.
namespace softbody {

/// Opaque. @param rgb 0 to 1.
std_msgs::ColorRGBA colorMessage(const Eigen::Vector3f& rgb);

/// The mesh as a TRIANGLE_LIST: orange where it was observed, grey where it is inferred. Colours include the
/// light of a lamp at the frame's origin, because rviz does not light coloured triangles.
/// @throw std::invalid_argument if revision or size of state and topology differ.
visualization_msgs::Marker makeSurfaceMarker(const MeshTopology& topology, const MeshState& state);

}  // namespace softbody
