#include "softbody_common/ros/run_node.h"
#include "softbody_sim/ros/nodes.h"

int main(int argc, char** argv) {
  return softbody::runNode(argc, argv, "simulator", softbody::makeSimulatorNode,
                           softbody::FreedMemory::kReturned);
}
