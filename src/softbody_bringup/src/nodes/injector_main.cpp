#include "softbody_bringup/injection/injector_node.h"
#include "softbody_common/run_node.h"

int main(int argc, char** argv) {
  return softbody::runNode<softbody::injection::InjectorNode>(argc, argv, "injector");
}
