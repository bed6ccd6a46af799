#pragma once

#include <geometry_msgs/PoseStamped.h>
#include <softbody_msgs/MeshTopology.h>
#include <visualization_msgs/InteractiveMarker.h>

namespace softbody {

/// An interactive marker of the body at rest. The user drags the mesh itself, or an arrow or a ring of an
/// axis.
/// @throw std::invalid_argument if the mesh is malformed.
visualization_msgs::InteractiveMarker makePoseMarker(const softbody_msgs::MeshTopology& mesh,
                                                     const geometry_msgs::PoseStamped& pose);

}  // namespace softbody
