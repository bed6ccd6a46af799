#pragma once

#include <memory>

namespace ros {
class NodeHandle;
}

/// The node of this package, for programs that drive it. @throw std::invalid_argument for a bad parameter.
namespace softbody::scanning {

std::shared_ptr<void> makeScanner(const ros::NodeHandle& handle, const ros::NodeHandle& private_handle);

}  // namespace softbody::scanning
