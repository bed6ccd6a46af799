#include "prediction/rigid_prediction.h"

#include "softbody_common/geometry/rigid_fit.h"
#include "softbody_common/time/time.h"

namespace softbody {
namespace {

// Longest extrapolation, in intervals between the last two states; after a longer gap the velocity is
// obsolete.
constexpr double kLongestExtrapolation = 3.0;
// Predictions that wait for their state. Live, a state may be a few frames late.
constexpr std::size_t kMostWaiting = 8;

Eigen::Vector3d rotationVector(const Eigen::Matrix3d& rotation) {
  const Eigen::AngleAxisd turn(rotation);
  return turn.angle() * turn.axis();
}

Eigen::Quaterniond quaternionOf(const Eigen::Vector3d& vector) {
  const double angle = vector.norm();
  return angle > 0.0 ? Eigen::Quaterniond(Eigen::AngleAxisd(angle, vector / angle))
                     : Eigen::Quaterniond::Identity();
}

}  // namespace

Eigen::Vector3d RigidPrediction::restCenter(std::size_t piece) const {
  return Points(rest_(pieces_[piece], Eigen::all)).colwise().mean();
}

RigidPrediction::Placed RigidPrediction::placed(const Points& vertices, Nanoseconds stamp) const {
  Placed result{vertices, {}, stamp};
  for (const std::vector<int>& piece : pieces_)
    result.poses.push_back(fitRigid(Points(rest_(piece, Eigen::all)), Points(vertices(piece, Eigen::all))));
  return result;
}

/// Those of the rigid motion only: deformation and its noise say nothing about the next motion.
Points RigidPrediction::corrections(const std::vector<Eigen::Isometry3d>& predicted,
                                    const Placed& now) const {
  Points result = Points::Zero(rest_.rows(), 3);
  for (std::size_t p = 0; p < pieces_.size(); ++p) {
    for (const int v : pieces_[p]) {
      const Eigen::Vector3d rest = rest_.row(v);
      result.row(v) = now.poses[p] * rest - predicted[p] * rest;
    }
  }
  return result;
}

double RigidPrediction::gainOf(const std::vector<int>& piece) const {
  double sum = 0.0;
  for (const int v : piece) sum += signal_.gain(v);
  return sum / static_cast<double>(piece.size());
}

void RigidPrediction::updateVelocities(const Placed& now) {
  velocities_.resize(pieces_.size());
  for (std::size_t p = 0; p < pieces_.size(); ++p) {
    const Eigen::Isometry3d &before = last_->poses[p], &after = now.poses[p];
    const Eigen::Vector3d center = restCenter(p);
    const double share = gainOf(pieces_[p]);
    const Velocity measured{(after * center - before * center) / interval_s_,
                            rotationVector(after.linear() * before.linear().transpose()) / interval_s_};
    velocities_[p].linear += share * (measured.linear - velocities_[p].linear);
    velocities_[p].angular += share * (measured.angular - velocities_[p].angular);
  }
}

void RigidPrediction::observe(const Points& vertices, Nanoseconds stamp) {
  if (last_ && stamp == last_->stamp) return;
  if (last_ && stamp < last_->stamp) reset();
  Placed now = placed(vertices, stamp);
  if (last_) {
    interval_s_ = seconds(stamp - last_->stamp);
    const auto predicted = predicted_.find(stamp);
    if (predicted != predicted_.end()) signal_.observe(corrections(predicted->second, now), interval_s_);
    updateVelocities(now);
  }
  predicted_.erase(predicted_.begin(), predicted_.upper_bound(stamp));
  last_ = std::move(now);
}

RigidPrediction::Velocity RigidPrediction::Velocity::knownPart(const MotionShare& share) const {
  Eigen::Matrix<double, 6, 1> both;
  both << angular, linear;
  both = share * both;
  return {both.tail<3>(), both.head<3>()};
}

Points RigidPrediction::at(Nanoseconds stamp, const std::vector<MotionShare>& known) {
  Points vertices = last_->vertices;
  std::vector<Eigen::Isometry3d> poses = last_->poses;
  const double ahead_s = seconds(stamp - last_->stamp);
  if (ahead_s > 0.0 && ahead_s <= kLongestExtrapolation * interval_s_) {
    for (std::size_t p = 0; p < pieces_.size(); ++p) {
      const Velocity velocity = p < known.size() ? velocities_[p].knownPart(known[p]) : velocities_[p];
      const Eigen::Vector3d center = last_->poses[p] * restCenter(p);
      const Eigen::Isometry3d motion = Eigen::Translation3d(center + ahead_s * velocity.linear) *
                                       quaternionOf(ahead_s * velocity.angular) *
                                       Eigen::Translation3d(-center);
      poses[p] = motion * poses[p];
      for (const int v : pieces_[p]) vertices.row(v) = motion * Eigen::Vector3d(last_->vertices.row(v));
    }
  }
  predicted_[stamp] = std::move(poses);
  if (predicted_.size() > kMostWaiting) predicted_.erase(predicted_.begin());
  return vertices;
}

void RigidPrediction::reset() {
  last_.reset();
  interval_s_ = 0.0;
  velocities_.clear();
  predicted_.clear();
  signal_.reset();
}

}  // namespace softbody
