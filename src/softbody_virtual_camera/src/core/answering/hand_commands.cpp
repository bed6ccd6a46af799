#include "softbody_virtual_camera/scenes/hand_commands.h"

namespace softbody::virtual_camera {

void HandCommands::takeOver() {
  const std::lock_guard lock(mutex_);
  order_.live = true;
}

void HandCommands::moveTo(const Eigen::Isometry3d& T_world_hand) {
  const std::lock_guard lock(mutex_);
  order_.T_world_hand = T_world_hand;
}

void HandCommands::close(bool close) {
  const std::lock_guard lock(mutex_);
  order_.close = close;
}

HandOrder HandCommands::now() const {
  const std::lock_guard lock(mutex_);
  return order_;
}

}  // namespace softbody::virtual_camera
