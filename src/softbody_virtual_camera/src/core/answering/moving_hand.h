#pragma once

#include "answering/answering_body.h"

namespace softbody::virtual_camera {

/// A hand that goes to its goal as fast as it can, then opens or closes. Its z axis points from the arm to
/// the body, y to the second finger.
class MovingHand {
 public:
  MovingHand(const HandShape& shape, const Eigen::Isometry3d& T_world_start);

  /// Advances by one step. @param close the fingers go together, or apart.
  void step(const Eigen::Isometry3d& T_world_goal, bool close, double duration_s);

  HandContact contact() const;

 private:
  HandShape shape_;
  Eigen::Isometry3d T_world_hand_;
  double open_ = 1.0;  ///< 0: closed
};

}  // namespace softbody::virtual_camera
