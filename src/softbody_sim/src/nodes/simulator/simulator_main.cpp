#include "nodes/compact_heap.h"
#include "nodes/simulator/simulator_node.h"
#include "softbody_common/ros/run_node.h"

int main(int argc, char** argv) {
  softbody::keepHeapCompact();
  return softbody::runNode<softbody::SimulatorNode>(argc, argv, "simulator");
}
