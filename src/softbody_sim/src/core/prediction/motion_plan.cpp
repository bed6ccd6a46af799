#include "softbody_sim/prediction/motion_plan.h"

#include <algorithm>
#include <cmath>

namespace softbody {

Eigen::Isometry3d RigidPath::at(double time_s, const Eigen::Vector3d& center) const {
  const auto after = std::lower_bound(times_s.begin(), times_s.end(), time_s);
  if (times_s.empty()) return Eigen::Isometry3d::Identity();
  if (after == times_s.end()) return motions.back();
  const auto k = static_cast<std::size_t>(after - times_s.begin());
  const Eigen::Isometry3d from = k == 0 ? Eigen::Isometry3d::Identity() : motions[k - 1];
  const double begin_s = k == 0 ? 0.0 : times_s[k - 1];
  const double share = (time_s - begin_s) / (times_s[k] - begin_s);
  const Eigen::Quaterniond turn(from.linear()), next(motions[k].linear());
  const Eigen::Vector3d moved = (1.0 - share) * (from * center) + share * (motions[k] * center);
  return Eigen::Translation3d(moved) * turn.slerp(share, next) * Eigen::Translation3d(-center);
}

bool ActivePeriod::contains(double time_s) const {
  return time_s > begin_s + kTimeRounding_s && time_s <= end_s + kTimeRounding_s;
}

bool ActivePeriod::holdsStep(double time_step_s) const {
  return contains((std::floor((begin_s + kTimeRounding_s) / time_step_s) + 1.0) * time_step_s);
}

}  // namespace softbody
