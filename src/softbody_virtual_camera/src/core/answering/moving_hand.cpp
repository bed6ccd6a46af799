#include "answering/moving_hand.h"

#include <Eigen/Dense>
#include <algorithm>

namespace softbody::virtual_camera {
namespace {

constexpr double kSpeed_m_s = 0.2, kTurn_rad_s = 2.0;
constexpr double kClosing_s = 0.3, kStroke_m = 0.02;  // of one finger

}  // namespace

MovingHand::MovingHand(const HandShape& shape, const Eigen::Isometry3d& T_world_start)
    : shape_(shape), T_world_hand_(T_world_start) {}

void MovingHand::step(const Eigen::Isometry3d& T_world_goal, bool close, double duration_s) {
  const Eigen::Vector3d way = T_world_goal.translation() - T_world_hand_.translation();
  const Eigen::Quaterniond now(T_world_hand_.linear()), goal(T_world_goal.linear());
  const double share = std::min(1.0, kSpeed_m_s * duration_s / std::max(way.norm(), 1e-9));
  const double turned = std::min(1.0, kTurn_rad_s * duration_s / std::max(now.angularDistance(goal), 1e-9));
  T_world_hand_.translation() += share * way;
  T_world_hand_.linear() = now.slerp(turned, goal).normalized().toRotationMatrix();
  open_ = std::clamp(open_ + (close ? -1.0 : 1.0) * duration_s / kClosing_s, 0.0, 1.0);
}

HandContact MovingHand::contact() const {
  HandContact contact;
  contact.T_world_hand = T_world_hand_;
  const double y = shape_.half_inside.y() + 0.5 * shape_.finger.y() + open_ * kStroke_m;
  for (const std::size_t side : {0u, 1u})
    contact.T_world_fingers[side] = T_world_hand_ * Eigen::Translation3d(0.0, side == 0 ? -y : y, 0.0);
  contact.closed = open_ == 0.0;
  return contact;
}

}  // namespace softbody::virtual_camera
