#pragma once

#include <softbody_msgs/MeshTopology.h>
#include <softbody_msgs/TetTopology.h>

#include <string>

#include "softbody_common/geometry/types.h"
#include "softbody_sim/interpolation/visual_surface.h"

namespace softbody {

/// The visual mesh bound to one topology of the volume.
struct BoundSurface {
  softbody_msgs::TetTopologyConstPtr volume;
  VisualSurface surface;
  softbody_msgs::MeshTopologyConstPtr topology;  ///< message of the surface's topology
};

/// Binds a surface and makes its topology message, which gets the stamp of the volume's.
BoundSurface bindTo(const softbody_msgs::TetTopologyConstPtr& volume, const VisualSurface& surface,
                    const std::string& body_frame);

/// Gives the topology message a stamp. If it has another one, it becomes a new message, because nodelets may
/// read the one that was sent. @return whether it is a new one.
bool setStamp(const ros::Time& stamp, BoundSurface* bound);

/// Whether a message carries the tets of a topology, whose vertices it rounds to single precision.
bool sameTets(const TetTopology& volume, const softbody_msgs::TetTopology& message);

}  // namespace softbody
