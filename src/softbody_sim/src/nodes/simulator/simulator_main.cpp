#include "nodes/compact_heap.h"
#include "softbody_common/ros/run_node.h"
#include "softbody_sim/ros/nodes.h"

int main(int argc, char** argv) {
  softbody::keepHeapCompact();
  return softbody::runNode(argc, argv, "simulator", softbody::makeSimulatorNode);
}
