#include <pluginlib/class_list_macros.hpp>

#include "nodes/scanner_node.h"
#include "softbody_common/ros/node_nodelet.h"
#include "softbody_scanning/ros/nodes.h"

namespace softbody::scanning {

class ScannerNodelet : public NodeNodelet<ScannerNode> {};

std::shared_ptr<void> makeScanner(const ros::NodeHandle& handle, const ros::NodeHandle& private_handle) {
  return std::make_shared<ScannerNode>(handle, private_handle);
}

}  // namespace softbody::scanning

PLUGINLIB_EXPORT_CLASS(softbody::scanning::ScannerNodelet, nodelet::Nodelet)
