#include <memory>

#include "softbody_common/ros/run_node.h"
#include "softbody_recordings/ros/injector_node.h"

int main(int argc, char** argv) {
  return softbody::runNode(argc, argv, "injector", [](const auto& handle, const auto& private_handle) {
    return std::shared_ptr<void>(std::make_shared<softbody::injection::InjectorNode>(handle, private_handle));
  });
}
