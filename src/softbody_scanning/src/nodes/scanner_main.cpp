#include "softbody_common/ros/run_node.h"
#include "softbody_scanning/ros/nodes.h"

int main(int argc, char** argv) {
  return softbody::runNode(argc, argv, "scanner", softbody::scanning::makeScanner);
}
