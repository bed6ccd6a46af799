#include "softbody_tracking/robot/robot_surfaces.h"

#include "robot/robot_view.h"
#include "softbody_common/geometry/rigid_fit.h"

namespace softbody {

std::vector<KnownSurface> robotSurfaces(const RobotDescription& robot, const LinkPose& pose,
                                        double deviation_m) {
  std::vector<KnownSurface> surfaces;
  for (const RobotLink& link : robot.links) {
    const std::optional<Eigen::Isometry3d> T_camera_link = pose(link.name);
    if (!T_camera_link || holdsCamera(link.surface, T_camera_link->inverse().translation())) continue;
    surfaces.push_back({link.name,
                        {transformed(link.surface.vertices, *T_camera_link), link.surface.triangles},
                        deviation_m});
  }
  return surfaces;
}

}  // namespace softbody
