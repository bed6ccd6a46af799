#pragma once

#include <memory>

namespace ros {
class NodeHandle;
}

/// The nodes of this package, for programs that drive them. Their callbacks come in the handles' queue.
/// All throw std::invalid_argument for a bad parameter.
namespace softbody {

std::shared_ptr<void> makeCameraIngest(const ros::NodeHandle& handle, const ros::NodeHandle& private_handle);
std::shared_ptr<void> makeFeatureTracker(const ros::NodeHandle& handle,
                                         const ros::NodeHandle& private_handle);
std::shared_ptr<void> makeToolTracker(const ros::NodeHandle& handle, const ros::NodeHandle& private_handle);
std::shared_ptr<void> makePoseMarker(const ros::NodeHandle& handle, const ros::NodeHandle& private_handle);

}  // namespace softbody
