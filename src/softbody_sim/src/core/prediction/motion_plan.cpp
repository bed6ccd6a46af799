#include "softbody_sim/prediction/motion_plan.h"

#include <algorithm>

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
  constexpr double kRounding_s = 1e-9;
  return time_s > begin_s + kRounding_s && time_s <= end_s + kRounding_s;
}

}  // namespace softbody
