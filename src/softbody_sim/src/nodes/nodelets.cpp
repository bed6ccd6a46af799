#include <pluginlib/class_list_macros.hpp>

#include "nodes/simulator/simulator_node.h"
#include "nodes/surface/surface_node.h"
#include "softbody_common/ros/node_nodelet.h"

namespace softbody {

class SimulatorNodelet : public NodeNodelet<SimulatorNode> {};
class SurfaceNodelet : public NodeNodelet<SurfaceNode> {};

}  // namespace softbody

PLUGINLIB_EXPORT_CLASS(softbody::SimulatorNodelet, nodelet::Nodelet)
PLUGINLIB_EXPORT_CLASS(softbody::SurfaceNodelet, nodelet::Nodelet)
