#include "softbody_recordings/ros/recorder_node.h"

#include <memory>

#include "softbody_common/ros/run_node.h"

int main(int argc, char** argv) {
  return softbody::runNode(argc, argv, "recorder", [](const auto& handle, const auto& private_handle) {
    return std::shared_ptr<void>(std::make_shared<softbody::RecorderNode>(handle, private_handle));
  });
}
