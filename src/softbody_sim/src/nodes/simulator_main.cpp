#include "nodes/run_node.h"
#include "nodes/simulator_node.h"

int main(int argc, char** argv) {
  return softbody::runNode<softbody::SimulatorNode>(argc, argv, "simulator");
}
