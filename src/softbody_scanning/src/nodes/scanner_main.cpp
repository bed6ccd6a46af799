#include "ros/nodes.h"
#include "softbody_common/ros/run_node.h"

int main(int argc, char** argv) {
  return softbody::runNode(argc, argv, "scanner", softbody::scanning::makeScanner);
}
