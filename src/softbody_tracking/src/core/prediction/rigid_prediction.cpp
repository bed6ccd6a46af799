#include "prediction/rigid_prediction.h"

#include "softbody_common/rigid_fit.h"
#include "softbody_common/time.h"

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

Eigen::Matrix3d rotationBy(const Eigen::Vector3d& vector) {
  const double angle = vector.norm();
  return angle > 0.0 ? Eigen::AngleAxisd(angle, vector / angle).toRotationMatrix()
                     : Eigen::Matrix3d::Identity();
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

double RigidPrediction::gainOf(const std::vector<int>& piece) const {
  double sum = 0.0;
  for (const int v : piece) sum += signal_.gain(v);
  return sum / static_cast<double>(piece.size());
}

/// The gain of the velocity that suits the gain of the position (Benedict and Bordner 1962).
void RigidPrediction::updateVelocities(const Placed& now) {
  velocities_.resize(pieces_.size());
  for (std::size_t p = 0; p < pieces_.size(); ++p) {
    const Eigen::Isometry3d &before = last_->poses[p], &after = now.poses[p];
    const Eigen::Vector3d center = restCenter(p);
    const double gain = gainOf(pieces_[p]), share = gain * gain / (2.0 - gain);
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
    if (predicted != predicted_.end()) signal_.observe(vertices - predicted->second, interval_s_);
    updateVelocities(now);
  }
  predicted_.erase(predicted_.begin(), predicted_.upper_bound(stamp));
  last_ = std::move(now);
}

Points RigidPrediction::at(Nanoseconds stamp, const std::vector<bool>& moving) {
  Points vertices = last_->vertices;
  const double ahead_s = seconds(stamp - last_->stamp);
  if (ahead_s > 0.0 && ahead_s <= kLongestExtrapolation * interval_s_) {
    for (std::size_t p = 0; p < pieces_.size(); ++p) {
      if (p < moving.size() && !moving[p]) continue;
      const Eigen::Vector3d center = last_->poses[p] * restCenter(p);
      const Eigen::Matrix3d turn = rotationBy(ahead_s * velocities_[p].angular);
      for (const int v : pieces_[p]) {
        const Eigen::Vector3d arm = last_->vertices.row(v).transpose() - center;
        vertices.row(v) = center + ahead_s * velocities_[p].linear + turn * arm;
      }
    }
  }
  predicted_[stamp] = vertices;
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
