#include <nodelet/nodelet.h>

#include <memory>
#include <pluginlib/class_list_macros.hpp>

#include "nodes/simulator_node.h"
#include "nodes/surface_node.h"

namespace softbody {

/// A node class in a nodelet manager.
template <typename Node>
class NodeNodelet : public nodelet::Nodelet {
  void onInit() override {
    try {
      node_ = std::make_unique<Node>(getNodeHandle(), getPrivateNodeHandle());
    } catch (const std::exception& error) {
      NODELET_FATAL_STREAM(error.what());
      throw;
    }
  }
  std::unique_ptr<Node> node_;
};

class SimulatorNodelet : public NodeNodelet<SimulatorNode> {};
class SurfaceNodelet : public NodeNodelet<SurfaceNode> {};

}  // namespace softbody

PLUGINLIB_EXPORT_CLASS(softbody::SimulatorNodelet, nodelet::Nodelet)
PLUGINLIB_EXPORT_CLASS(softbody::SurfaceNodelet, nodelet::Nodelet)
