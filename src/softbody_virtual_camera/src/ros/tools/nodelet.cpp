#include <pluginlib/class_list_macros.hpp>

#include "ros/node.h"
#include "softbody_common/ros/node_nodelet.h"

namespace softbody::virtual_camera {

class ShippedCamera : public VirtualCameraNode {
 public:
  ShippedCamera(const ros::NodeHandle& handle, const ros::NodeHandle& private_handle)
      : VirtualCameraNode(handle, private_handle, shippedSetup()) {}
};
class VirtualCameraNodelet : public NodeNodelet<ShippedCamera> {};

}  // namespace softbody::virtual_camera

PLUGINLIB_EXPORT_CLASS(softbody::virtual_camera::VirtualCameraNodelet, nodelet::Nodelet)
