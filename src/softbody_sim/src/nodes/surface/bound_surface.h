#pragma once

#include <softbody_msgs/MeshTopology.h>
#include <softbody_msgs/TetTopology.h>

#include <string>

#include "softbody_common/types.h"
#include "softbody_sim/interpolation/visual_surface.h"

namespace softbody {

/// The visual mesh bound to one topology of the volume.
struct BoundSurface {
  softbody_msgs::TetTopologyConstPtr volume;
  VisualSurface surface;
  softbody_msgs::MeshTopologyPtr topology;  ///< message of the surface's topology
};

/// Binds a surface and makes its topology message, which gets the stamp of the volume's.
BoundSurface bindTo(const softbody_msgs::TetTopologyConstPtr& volume, const VisualSurface& surface,
                    const std::string& body_frame);

/// Whether two messages carry the same mesh; their headers may differ.
bool sameMesh(const softbody_msgs::TetTopology& a, const softbody_msgs::TetTopology& b);

/// Whether a message carries the tets of a topology, whose vertices it rounds to single precision.
bool sameTets(const TetTopology& volume, const softbody_msgs::TetTopology& message);

}  // namespace softbody
