#include "nodes/surface/bound_surface.h"

#include <boost/make_shared.hpp>

#include "softbody_common/geometry/tet_topology_check.h"
#include "softbody_common/ros/conversions.h"

namespace softbody {

BoundSurface bindTo(const softbody_msgs::TetTopologyConstPtr& volume, const VisualSurface& surface,
                    const std::string& body_frame) {
  const auto topology = boost::make_shared<softbody_msgs::MeshTopology>(toMessage(surface.topology()));
  topology->header.frame_id = body_frame;
  topology->header.stamp = volume->header.stamp;
  return {volume, surface, topology};
}

bool setStamp(const ros::Time& stamp, BoundSurface* bound) {
  if (bound->topology->header.stamp == stamp) return false;
  const auto stamped = boost::make_shared<softbody_msgs::MeshTopology>(*bound->topology);
  stamped->header.stamp = stamp;
  bound->topology = stamped;
  return true;
}

bool sameTets(const TetTopology& volume, const softbody_msgs::TetTopology& message) {
  return volume.revision == message.revision &&
         static_cast<std::size_t>(volume.tets.rows()) == message.tets.size() &&
         sameRestBody(volume, fromMessage(message));
}

}  // namespace softbody
