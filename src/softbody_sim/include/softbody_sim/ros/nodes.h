#pragma once

#include <memory>

namespace ros {
class NodeHandle;
}

/// The nodes of this package, for programs that drive them. Their callbacks come in the handles' queue.
/// Simulator and surface throw std::invalid_argument if a parameter or a file of the object cannot be used.
namespace softbody {

std::shared_ptr<void> makeSimulatorNode(const ros::NodeHandle& handle, const ros::NodeHandle& private_handle);
std::shared_ptr<void> makeSurfaceNode(const ros::NodeHandle& handle, const ros::NodeHandle& private_handle);
std::shared_ptr<void> makeModelServer(const ros::NodeHandle& handle, const ros::NodeHandle& private_handle);

}  // namespace softbody
