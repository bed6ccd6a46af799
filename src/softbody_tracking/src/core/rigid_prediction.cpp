#include "rigid_prediction.h"

#include "softbody_common/rigid_fit.h"

namespace softbody {
namespace {

constexpr double kLongestExtrapolation = 3.0;  // intervals between the states

}  // namespace

void RigidPrediction::observe(const Points& vertices, Nanoseconds stamp) {
  if (last_ && stamp == last_->stamp) return;
  before_ = last_;
  last_ = Placed{fitRigid(rest_, vertices), vertices.colwise().mean().transpose(), stamp};
  if (before_ && stamp < before_->stamp) before_.reset();
}

Eigen::Isometry3d RigidPrediction::motionUntil(Nanoseconds stamp) const {
  Eigen::Isometry3d motion = Eigen::Isometry3d::Identity();
  if (!last_ || !before_ || stamp <= last_->stamp) return motion;
  const double intervals =
      static_cast<double>(stamp - last_->stamp) / static_cast<double>(last_->stamp - before_->stamp);
  if (intervals > kLongestExtrapolation) return motion;
  const Eigen::AngleAxisd turn(last_->pose.linear() * before_->pose.linear().transpose());
  motion.linear() = Eigen::AngleAxisd(intervals * turn.angle(), turn.axis()).toRotationMatrix();
  motion.translation() =
      last_->center + intervals * (last_->center - before_->center) - motion.linear() * last_->center;
  return motion;
}

}  // namespace softbody
