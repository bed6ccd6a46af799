#pragma once

#include <geometry_msgs/PoseStamped.h>
#include <softbody_msgs/MeshTopology.h>
#include <visualization_msgs/InteractiveMarker.h>

namespace softbody {

/// The body at rest, to be moved and turned by hand: the mesh itself can be dragged, and each axis has an
/// arrow and a ring. @throw std::invalid_argument if the mesh is no mesh.
visualization_msgs::InteractiveMarker makePoseMarker(const softbody_msgs::MeshTopology& mesh,
                                                     const geometry_msgs::PoseStamped& pose);

}  // namespace softbody
