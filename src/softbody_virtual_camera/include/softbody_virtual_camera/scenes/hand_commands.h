#pragma once

#include <Eigen/Geometry>
#include <mutex>
#include <optional>

namespace softbody::virtual_camera {

/// What a hand is told to do.
struct HandOrder {
  bool live = false;  ///< false: the scene's own script moves the hand
  std::optional<Eigen::Isometry3d> T_world_hand = std::nullopt;  ///< its goal; none: where it rests
  bool close = false;
};

/// Orders from outside for the hand of a scene. Threads may share it.
class HandCommands {
 public:
  /// From now on the hand does what it is told, and rests until then.
  void takeOver();
  void moveTo(const Eigen::Isometry3d& T_world_hand);
  void close(bool close);

  HandOrder now() const;

 private:
  mutable std::mutex mutex_;
  HandOrder order_;
};

}  // namespace softbody::virtual_camera
