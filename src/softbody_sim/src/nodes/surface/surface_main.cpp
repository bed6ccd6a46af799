#include "softbody_common/ros/run_node.h"
#include "softbody_sim/ros/nodes.h"

int main(int argc, char** argv) {
  return softbody::runNode(argc, argv, "surface", softbody::makeSurfaceNode,
                           softbody::FreedMemory::kReturned);
}
