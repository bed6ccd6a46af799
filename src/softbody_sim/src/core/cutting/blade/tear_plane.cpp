#include "cutting/blade/tear_plane.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

#include "softbody_common/statistics/median.h"

namespace softbody {
namespace {

constexpr double kLeastWidth = 1e-4;  // [m]
constexpr double kWrongShare = 0.05;  // of the marks: wrong matches, of which nothing is known

/// How finely marks tell a place: the median distance to the nearest other mark [m].
double spacingOf(const std::vector<TearMark>& marks) {
  std::vector<double> spacings;
  for (const TearMark& mark : marks) {
    double nearest = std::numeric_limits<double>::infinity();
    for (const TearMark& other : marks)
      if (&other != &mark) nearest = std::min(nearest, (other.rest - mark.rest).norm());
    spacings.push_back(nearest);
  }
  return median(&spacings);
}

/// The plane n . (x - zone) + tilts . (u, v) + shift = 0, with unknown tilts and shift.
class Separation {
 public:
  Separation(const TearZone& zone, const std::vector<TearMark>& marks)
      : zone_(zone),
        width_(std::max(spacingOf(marks), kLeastWidth)),
        u_(zone.plane.normal.unitOrthogonal()),
        v_(zone.plane.normal.cross(u_)) {
    for (const TearMark& mark : marks) {
      const Eigen::Vector3d arm = mark.rest - zone.plane.point;
      rows_.push_back({mark.side * zone.plane.normal.dot(arm),
                       mark.side * Eigen::Vector3d(u_.dot(arm), v_.dot(arm), 1.0)});
    }
    precision_ << std::pow(zone.tilt_rad, -2), std::pow(zone.tilt_rad, -2), std::pow(zone.place_m, -2);
  }

  /// The middle of the equally good shifts, then Newton steps from there.
  RestPlane best() const {
    Eigen::Vector3d found = bestShift();
    for (int step = 0; step < kSteps; ++step) found += newtonStep(found);
    const Eigen::Vector3d normal = zone_.plane.normal + found[0] * u_ + found[1] * v_;
    return {zone_.plane.point - found[2] * zone_.plane.normal, normal.normalized()};
  }

 private:
  static constexpr int kSteps = 20;  // of Newton: far more than quadratic convergence takes
  struct Row {
    double height;          ///< over the zone's plane, positive on the mark's own side [m]
    Eigen::Vector3d slope;  ///< of the height by tilts and shift
  };
  double heightOf(const Row& row, const Eigen::Vector3d& at) const {
    return (row.height + row.slope.dot(at)) / width_;
  }
  /// Minus the logarithm of the probability.
  double costOf(const Eigen::Vector3d& at) const {
    double cost = 0.5 * at.dot(precision_.cwiseProduct(at));
    for (const Row& row : rows_)
      cost -= std::log(kWrongShare + (1.0 - kWrongShare) / (1.0 + std::exp(-heightOf(row, at))));
    return cost;
  }
  Eigen::Vector3d bestShift() const {
    constexpr double kAlike = 0.5;  // of the cost: less than a standard deviation from the best
    const int count = static_cast<int>(std::ceil(3.0 * zone_.place_m / width_));
    double least = std::numeric_limits<double>::infinity();
    for (int k = -count; k <= count; ++k) least = std::min(least, costOf({0.0, 0.0, k * width_}));
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    int alike = 0;
    for (int k = -count; k <= count; ++k) {
      if (costOf({0.0, 0.0, k * width_}) > least + kAlike) continue;
      sum.z() += k * width_;
      ++alike;
    }
    return sum / alike;
  }
  /// Expectation maximisation: each mark counts as far as it is no wrong match.
  Eigen::Vector3d newtonStep(const Eigen::Vector3d& at) const {
    Eigen::Vector3d gradient = precision_.cwiseProduct(at);
    Eigen::Matrix3d H = precision_.asDiagonal();
    for (const Row& row : rows_) {
      const double right = 1.0 / (1.0 + std::exp(-heightOf(row, at)));
      const double trust = (1.0 - kWrongShare) * right / (kWrongShare + (1.0 - kWrongShare) * right);
      gradient -= trust * (1.0 - right) / width_ * row.slope;
      H += trust * right * (1.0 - right) / (width_ * width_) * row.slope * row.slope.transpose();
    }
    const Eigen::Vector3d step = -H.ldlt().solve(gradient);
    const double longest = std::max(std::abs(step.z()), zone_.place_m * step.head<2>().norm());
    return std::min(1.0, 2.0 * width_ / std::max(longest, 1e-12)) * step;
  }

  const TearZone& zone_;
  const double width_;  ///< over which a mark changes its side [m]
  const Eigen::Vector3d u_, v_;
  std::vector<Row> rows_;
  Eigen::Vector3d precision_;
};

}  // namespace

RestPlane tearPlane(const TearZone& zone, const std::vector<TearMark>& marks) {
  const auto tells = [](const TearMark& mark) { return mark.side != 0.0; };
  std::vector<TearMark> telling;
  std::copy_if(marks.begin(), marks.end(), std::back_inserter(telling), tells);
  return telling.size() > 1 ? Separation(zone, telling).best() : zone.plane;
}

}  // namespace softbody
