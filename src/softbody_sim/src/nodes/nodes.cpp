#include "softbody_sim/ros/nodes.h"

#include "nodes/model/model_server.h"
#include "nodes/simulator/simulator_node.h"
#include "nodes/surface/surface_node.h"

namespace softbody {

std::shared_ptr<void> makeSimulatorNode(const ros::NodeHandle& handle,
                                        const ros::NodeHandle& private_handle) {
  return std::make_shared<SimulatorNode>(handle, private_handle);
}

std::shared_ptr<void> makeSurfaceNode(const ros::NodeHandle& handle, const ros::NodeHandle& private_handle) {
  return std::make_shared<SurfaceNode>(handle, private_handle);
}

std::shared_ptr<void> makeModelServer(const ros::NodeHandle& handle, const ros::NodeHandle& private_handle) {
  return std::make_shared<ModelServer>(handle, private_handle);
}

}  // namespace softbody
