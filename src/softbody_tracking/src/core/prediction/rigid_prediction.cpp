#include "prediction/rigid_prediction.h"

#include "softbody_common/rigid_fit.h"

namespace softbody {
namespace {

// Longest extrapolation, in intervals between the last two states; after a longer gap the velocity is
// obsolete.
constexpr double kLongestExtrapolation = 3.0;

/// The motion from `before` to `last`, continued from `last` for a number of intervals.
Eigen::Isometry3d continued(const Eigen::Isometry3d& before, const Eigen::Isometry3d& last,
                            const Eigen::Vector3d& rest_center, double intervals) {
  const Eigen::AngleAxisd turn(last.linear() * before.linear().transpose());
  const Eigen::Vector3d center = last * rest_center;
  Eigen::Isometry3d motion = Eigen::Isometry3d::Identity();
  motion.linear() = Eigen::AngleAxisd(intervals * turn.angle(), turn.axis()).toRotationMatrix();
  motion.translation() = center + intervals * (center - before * rest_center) - motion.linear() * center;
  return motion;
}

}  // namespace

void RigidPrediction::observe(const Points& vertices, Nanoseconds stamp) {
  if (last_ && stamp == last_->stamp) return;
  before_ = std::move(last_);
  last_ = Placed{vertices, {}, stamp};
  for (const std::vector<int>& piece : pieces_) {
    last_->poses.push_back(fitRigid(Points(rest_(piece, Eigen::all)), Points(vertices(piece, Eigen::all))));
  }
  if (before_ && stamp < before_->stamp) before_.reset();
}

Points RigidPrediction::at(Nanoseconds stamp, const std::vector<bool>& moving) const {
  Points vertices = last_->vertices;
  if (!before_ || stamp <= last_->stamp) return vertices;
  const double intervals =
      static_cast<double>(stamp - last_->stamp) / static_cast<double>(last_->stamp - before_->stamp);
  if (intervals > kLongestExtrapolation) return vertices;
  for (std::size_t p = 0; p < pieces_.size(); ++p) {
    if (p < moving.size() && !moving[p]) continue;
    const Eigen::Vector3d center = Points(rest_(pieces_[p], Eigen::all)).colwise().mean();
    const Eigen::Isometry3d motion = continued(before_->poses[p], last_->poses[p], center, intervals);
    for (int v : pieces_[p]) vertices.row(v) = motion * last_->vertices.row(v).transpose();
  }
  return vertices;
}

}  // namespace softbody
