#include "softbody_scanning/registration/surface_registration.h"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

#include "registration/registration_side.h"

namespace softbody::scanning {
namespace {

constexpr double kOtherSize = 3.0;        // of the diagonals
constexpr int kCoarse = 200;              // samples that tell starts apart
constexpr int kFine = 5000;               // samples of the final fit
constexpr std::size_t kKept = 12;         // starts that are fitted to the end
constexpr double kCoarseScale = 0.05;     // of the weights, in diagonals: an error of a few degrees
constexpr double kFineScale = 0.002;      // 0.5 mm of a body of 250 mm: about what a good scan is wrong by
constexpr double kOther_rad = 0.35;       // from here on two motions are different answers
constexpr std::size_t kLowestShare = 50;  // the lowest 2 % of a surface touch the table
constexpr int kCoarseSteps = 12, kFineSteps = 60;  // the fit ends earlier where it stands still

using Vector6 = Eigen::Matrix<double, 6, 1>;
using Matrix6 = Eigen::Matrix<double, 6, 6>;

/// The 24 rotations that take the axes onto the axes.
std::vector<Eigen::Matrix3d> axisRotations() {
  std::vector<Eigen::Matrix3d> rotations;
  for (int x = 0; x < 3; ++x) {
    for (int y = 0; y < 3; ++y) {
      for (int signs = 0; x != y && signs < 4; ++signs) {
        Eigen::Matrix3d R;
        R.col(0) = ((signs & 1) != 0 ? -1.0 : 1.0) * Eigen::Vector3d::Unit(x);
        R.col(1) = ((signs & 2) != 0 ? -1.0 : 1.0) * Eigen::Vector3d::Unit(y);
        R.col(2) = R.col(0).cross(R.col(1));
        rotations.push_back(R);
      }
    }
  }
  return rotations;
}

/// Starting poses. Turns by 45 degrees, for bodies whose principal axes say nothing.
std::vector<Eigen::Isometry3d> starts(const RegistrationSide& moving, const RegistrationSide& fixed) {
  const Eigen::Matrix3d from = moving.axes(), to = fixed.axes();
  std::vector<Eigen::Isometry3d> poses;
  for (const Eigen::Matrix3d& R : axisRotations()) {
    for (int turned = 0; turned < 4; ++turned) {
      Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
      if (turned > 0) turn = Eigen::AngleAxisd(0.25 * M_PI, Eigen::Vector3d::Unit(turned - 1)).matrix();
      Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
      pose.linear() = to * turn * R * from.transpose();
      pose.translation() = fixed.middle() - pose.linear() * moving.middle();
      poses.push_back(pose);
    }
  }
  return poses;
}

/// Sums of a step's normal equations.
struct NormalEquations {
  Matrix6 matrix = Matrix6::Zero();
  Vector6 right_side = Vector6::Zero();

  /// A residual whose derivative by a rotation about the centre, times the body's size, and a shift is `row`.
  void add(double weight, const Vector6& row, double residual) {
    matrix += weight * row * row.transpose();
    right_side -= weight * residual * row;
  }
};

/// Geman and McClure's weight. @param scale distance at which three quarters of it are lost [m].
double weightOf(double square, double scale) { return std::pow(1.0 + square / (scale * scale), -2.0); }

/// The place at which moved samples touch a plane: the mean of what is as low as the lowest, up to noise.
Eigen::Vector3d contactOf(const std::vector<SurfaceSample>& samples, const Eigen::Isometry3d& T,
                          const Eigen::Hyperplane<double, 3>& table, double noise) {
  std::vector<double> heights;
  for (const SurfaceSample& sample : samples) heights.push_back(table.signedDistance(T * sample.position));
  std::vector<double> sorted = heights;
  const auto low = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / kLowestShare);
  std::nth_element(sorted.begin(), low, sorted.end());
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  double weights = 0.0;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const double above = std::max(0.0, heights[i] - *low), weight = weightOf(above * above, noise);
    sum += weight * (T * samples[i].position);
    weights += weight;
  }
  return sum / weights;
}

/// Each surface touches the table of the other, as surely as all samples together say anything.
void addTables(const RegistrationSide& moving, const RegistrationSide& fixed, const Eigen::Isometry3d& pose,
               NormalEquations* sums) {
  const double noise = kFineScale * fixed.diagonal();
  const auto add = [&](const Eigen::Vector3d& place, const Eigen::Vector3d& normal, double residual) {
    Vector6 row;
    row << (place - pose * moving.middle()).cross(normal) / fixed.diagonal(), normal;
    sums->add(static_cast<double>(moving.samples().size()), row, residual);
  };
  if (fixed.table()) {
    const Eigen::Vector3d place = contactOf(moving.samples(), pose, *fixed.table(), noise);
    add(place, fixed.table()->normal(), fixed.table()->signedDistance(place));
  }
  if (moving.table()) {
    const Eigen::Vector3d place = contactOf(fixed.samples(), pose.inverse(), *moving.table(), noise);
    add(pose * place, pose.linear() * moving.table()->normal(), -moving.table()->signedDistance(place));
  }
}

/// One Gauss-Newton step. @param scale distance at which a point loses three quarters of its weight [m].
/// @return about how far it moves a point [m].
double improve(const RegistrationSide& moving, const RegistrationSide& fixed, double scale,
               Eigen::Isometry3d* pose) {
  const double size = fixed.diagonal();
  const Eigen::Vector3d centre = *pose * moving.middle();
  NormalEquations sums;
  for (const SurfaceSample& sample : moving.samples()) {
    const Eigen::Vector3d moved = *pose * sample.position;
    const RegistrationSide::Closest nearest = fixed.closest(moved);
    if (!nearest.seen) continue;
    const Eigen::Vector3d offset = moved - nearest.position;
    const double weight = weightOf(offset.squaredNorm(), scale);
    Vector6 row;
    row << (moved - centre).cross(nearest.normal) / size, nearest.normal;  // all entries have one size
    sums.add(weight, row, nearest.normal.dot(offset));
  }
  addTables(moving, fixed, *pose, &sums);
  // A ball may turn freely: such a turn stays zero.
  sums.matrix.diagonal().array() += 1e-9 * sums.matrix.trace() + 1e-300;
  const Vector6 step = sums.matrix.ldlt().solve(sums.right_side);
  const Eigen::Vector3d turn = step.head<3>() / size;
  Eigen::Isometry3d update = Eigen::Isometry3d::Identity();
  if (turn.norm() > 0.0) update.linear() = Eigen::AngleAxisd(turn.norm(), turn.normalized()).matrix();
  update.translation() = centre + step.tail<3>() - update.linear() * centre;
  *pose = update * *pose;
  return step.norm();
}

/// Median distance of the moved samples [m].
double typicalDistance(const RegistrationSide& moving, const RegistrationSide& fixed,
                       const Eigen::Isometry3d& pose) {
  std::vector<double> distances;
  for (const SurfaceSample& sample : moving.samples()) {
    const RegistrationSide::Closest nearest = fixed.closest(pose * sample.position);
    if (nearest.seen) distances.push_back((pose * sample.position - nearest.position).norm());
  }
  if (distances.empty()) return fixed.diagonal();
  const auto middle = distances.begin() + static_cast<std::ptrdiff_t>(distances.size() / 2);
  std::nth_element(distances.begin(), middle, distances.end());
  return *middle;
}

/// 1 minus the correlation of the colours of places that lie on each other; 0 if they have one colour.
double colorMisfit(const std::vector<std::pair<Eigen::Vector3d, Eigen::Vector3d>>& pairs) {
  Eigen::Vector3d first = Eigen::Vector3d::Zero(), second = Eigen::Vector3d::Zero();
  for (const auto& [a, b] : pairs) first += a, second += b;
  first /= static_cast<double>(pairs.size());
  second /= static_cast<double>(pairs.size());
  double aa = 0.0, bb = 0.0, ab = 0.0;
  for (const auto& [a, b] : pairs) {
    aa += (a - first).squaredNorm();
    bb += (b - second).squaredNorm();
    ab += (a - first).dot(b - second);
  }
  const double total = std::sqrt(aa * bb),
               rounding = static_cast<double>(pairs.size());  // one step of 8 bits
  return (total - ab) / (total + rounding);
}

/// Mean of Geman and McClure's cost in one direction, 0..1, and that of the colours.
double misfit(const RegistrationSide& from, const RegistrationSide& to, double scale,
              const Eigen::Isometry3d& T, bool with_colors) {
  double sum = 0.0;
  int counted = 0;
  std::vector<std::pair<Eigen::Vector3d, Eigen::Vector3d>> colors;
  for (const SurfaceSample& sample : from.samples()) {
    const RegistrationSide::Closest nearest = to.closest(T * sample.position);
    if (!nearest.seen) continue;
    const double square = (T * sample.position - nearest.position).squaredNorm() / (scale * scale);
    sum += square / (1.0 + square);
    ++counted;
    if (square < 1.0) colors.emplace_back(sample.color, nearest.color);
  }
  const double shape = counted > 0 ? sum / counted : 1.0;
  return shape + (with_colors && !colors.empty() ? colorMisfit(colors) : 0.0);
}

double misfitOfBoth(const RegistrationSide& moving, const RegistrationSide& fixed, double scale,
                    const Eigen::Isometry3d& T, bool with_colors) {
  return 0.5 * (misfit(moving, fixed, scale, T, with_colors) +
                misfit(fixed, moving, scale, T.inverse(), with_colors));
}

/// From far to near: the scale falls with the distance that is left.
void refine(const RegistrationSide& moving, const RegistrationSide& fixed, Eigen::Isometry3d* pose) {
  const double size = fixed.diagonal();
  for (int i = 0; i < kFineSteps; ++i) {
    const double scale =
        std::clamp(3.0 * typicalDistance(moving, fixed, *pose), kFineScale * size, kCoarseScale * size);
    if (improve(moving, fixed, scale, pose) < 1e-7 * size) return;
  }
}

struct Candidate {
  Eigen::Isometry3d pose;
  double misfit;
};

bool fitsBetter(const Candidate& a, const Candidate& b) { return a.misfit < b.misfit; }

/// The starts that fit best, each as well as it can.
std::vector<Candidate> candidatesOf(const RegisteredSurface& moving, const RegisteredSurface& fixed) {
  const RegistrationSide few_moving(moving, kCoarse), few_fixed(fixed, kCoarse);
  const double size = few_fixed.diagonal();
  std::vector<Candidate> candidates;
  for (Eigen::Isometry3d pose : starts(RegistrationSide(moving, kFine), RegistrationSide(fixed, kFine))) {
    for (int i = 0; i < kCoarseSteps; ++i) improve(few_moving, few_fixed, kCoarseScale * size, &pose);
    candidates.push_back({pose, misfitOfBoth(few_moving, few_fixed, kCoarseScale * size, pose, false)});
  }
  std::stable_sort(candidates.begin(), candidates.end(), fitsBetter);
  candidates.resize(std::min(candidates.size(), kKept));
  const RegistrationSide more_moving(moving, 5 * kCoarse), more_fixed(fixed, 5 * kCoarse);
  for (Candidate& candidate : candidates) {
    refine(few_moving, few_fixed, &candidate.pose);
    candidate.misfit = misfitOfBoth(more_moving, more_fixed, 5.0 * kFineScale * size, candidate.pose, true);
  }
  std::stable_sort(candidates.begin(), candidates.end(), fitsBetter);
  return candidates;
}

}  // namespace

Registration registerSurfaces(const RegisteredSurface& moving, const RegisteredSurface& fixed) {
  const RegistrationSide many_moving(moving, kFine), many_fixed(fixed, kFine);
  const double a = many_moving.diagonal(), b = many_fixed.diagonal();
  if (a > kOtherSize * b || b > kOtherSize * a)
    throw std::invalid_argument(fmt::format(
        "one surface is {:.4g} m large and the other {:.4g} m: they are not the same body", a, b));
  const std::vector<Candidate> candidates = candidatesOf(moving, fixed);
  Registration found{candidates.front().pose, candidates.front().misfit, 2.0, 0.0};
  for (const Candidate& other : candidates) {
    const Eigen::AngleAxisd turn(found.T_fixed_moving.linear().transpose() * other.pose.linear());
    if (turn.angle() > kOther_rad) found.runner_up = std::min(found.runner_up, other.misfit);
  }
  refine(many_moving, many_fixed, &found.T_fixed_moving);
  found.distance_m = typicalDistance(many_moving, many_fixed, found.T_fixed_moving);
  return found;
}

}  // namespace softbody::scanning
