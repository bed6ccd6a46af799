#include "softbody_common/ros/run_node.h"
#include "softbody_recordings/ros/injector_node.h"

int main(int argc, char** argv) {
  return softbody::runNode<softbody::injection::InjectorNode>(argc, argv, "injector");
}
