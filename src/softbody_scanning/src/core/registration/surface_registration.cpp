#include "softbody_scanning/registration/surface_registration.h"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

#include "registration/registration_side.h"
#include "softbody_common/geometry/rigid_motion.h"
#include "softbody_common/statistics/median.h"

namespace softbody::scanning {
namespace {

constexpr double kOtherSize = 3.0;     // of the diagonals
constexpr int kCoarse = 200;           // samples that tell starts apart
constexpr int kFine = 5000;            // samples of the final fit
constexpr int kStarts = 600;           // rotations 25 degrees apart
constexpr std::size_t kKept = 24;      // starts that are fitted to the end
constexpr double kUnknownCost = 0.5;   // of a place inside the part of the other surface that was not seen
constexpr double kCoarseScale = 0.05;  // of the weights, in diagonals: an error of a few degrees
constexpr double kFineScale = 0.002;   // 0.5 mm of a body of 250 mm: about what a good scan is wrong by
constexpr double kOther_rad = 0.35;    // from here on two motions are different answers
constexpr double kClearly = 2.0;       // an answer is clear if the others are worse by this factor
constexpr double kChanceSigmas = 3.0;  // correlations up to here are chance
constexpr double kTurned_cos = 0.7;    // less than 45 degrees are no turn
constexpr double kContactShare = 0.1;  // of all samples: so much counts that a surface touches a table
constexpr int kCoarseSteps = 12, kFineSteps = 60;  // the fit ends earlier where it stands still

using Vector6 = Eigen::Matrix<double, 6, 1>;
using Matrix6 = Eigen::Matrix<double, 6, 6>;

/// Rotations that are spread evenly (super-Fibonacci spirals, Alexa 2022).
std::vector<Eigen::Matrix3d> evenRotations(int count) {
  constexpr double kPhi = 1.4142135623730951, kPsi = 1.5337511687552043;
  std::vector<Eigen::Matrix3d> rotations;
  for (int i = 0; i < count; ++i) {
    const double s = i + 0.5, r = std::sqrt(s / count), q = std::sqrt(1.0 - s / count);
    const double alpha = 2.0 * M_PI * s / kPhi, beta = 2.0 * M_PI * s / kPsi;
    rotations.push_back(
        Eigen::Quaterniond(q * std::cos(beta), r * std::sin(alpha), r * std::cos(alpha), q * std::sin(beta))
            .toRotationMatrix());
  }
  return rotations;
}

/// Starting poses.
std::vector<Eigen::Isometry3d> starts(const RegistrationSide& moving, const RegistrationSide& fixed) {
  std::vector<Eigen::Isometry3d> poses;
  for (const Eigen::Matrix3d& R : evenRotations(kStarts)) {
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
    pose.linear() = R;
    pose.translation() = fixed.middle() - R * moving.middle();
    poses.push_back(pose);
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

/// The lowest moved place above a plane.
Eigen::Vector3d lowest(const std::vector<Eigen::Vector3d>& places, const Eigen::Isometry3d& T,
                       const Eigen::Hyperplane<double, 3>& table) {
  const Eigen::Vector3d up = T.linear().transpose() * table.normal();
  return T * *std::min_element(places.begin(), places.end(),
                               [&](const auto& a, const auto& b) { return up.dot(a) < up.dot(b); });
}

/// Each surface touches the table of the other.
void addTables(const RegistrationSide& moving, const RegistrationSide& fixed, const Eigen::Isometry3d& pose,
               NormalEquations* sums) {
  const auto add = [&](const Eigen::Vector3d& place, const Eigen::Vector3d& normal, double residual) {
    Vector6 row;
    row << (place - pose * moving.middle()).cross(normal) / fixed.diagonal(), normal;
    sums->add(kContactShare * static_cast<double>(moving.samples().size()), row, residual);
  };
  if (fixed.table()) {
    const Eigen::Vector3d place = lowest(moving.seenPlaces(), pose, *fixed.table());
    add(place, fixed.table()->normal(), fixed.table()->signedDistance(place));
  }
  if (moving.table()) {
    const Eigen::Vector3d place = lowest(fixed.seenPlaces(), pose.inverse(), *moving.table());
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
    const Eigen::Vector3d offset = moved - nearest.position;
    if (!nearest.seen && nearest.normal.dot(offset) <= 0.0) continue;
    const double weight = weightOf(offset.squaredNorm(), scale);
    Vector6 row;
    row << (moved - centre).cross(nearest.normal) / size, nearest.normal;  // all entries have one size
    sums.add(weight, row, nearest.normal.dot(offset));
  }
  addTables(moving, fixed, *pose, &sums);
  // A ball may turn freely: such a turn stays zero.
  sums.matrix.diagonal().array() += 1e-9 * sums.matrix.trace() + 1e-300;
  const Vector6 step = sums.matrix.ldlt().solve(sums.right_side);
  *pose = rigidMotion(step.head<3>() / size, step.tail<3>(), centre) * *pose;
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
  return median(&distances);
}

/// How well two surfaces fit.
struct Fit {
  double misfit = 0.0;       ///< as Registration's
  double correlation = 0.0;  ///< of the colours of places that lie on each other; 1 if they have one colour
  std::size_t pairs = 0;     ///< number of these places
};

double colorCorrelation(const std::vector<std::pair<Eigen::Vector3d, Eigen::Vector3d>>& pairs) {
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
  return (ab + rounding) / (total + rounding);
}

/// Mean of Geman and McClure's cost in one direction, 0..1, and that of the colours.
Fit fit(const RegistrationSide& from, const RegistrationSide& to, double scale, const Eigen::Isometry3d& T,
        bool with_colors) {
  double sum = 0.0;
  std::vector<std::pair<Eigen::Vector3d, Eigen::Vector3d>> colors;
  for (const SurfaceSample& sample : from.samples()) {
    const RegistrationSide::Closest nearest = to.closest(T * sample.position);
    const Eigen::Vector3d offset = T * sample.position - nearest.position;
    const double square = offset.squaredNorm() / (scale * scale);
    const bool unknown = !nearest.seen && nearest.normal.dot(offset) <= 0.0;
    sum += unknown ? kUnknownCost : square / (1.0 + square);
    if (nearest.seen && square < 1.0) colors.emplace_back(sample.color, nearest.color);
  }
  const double shape = sum / static_cast<double>(from.samples().size());
  const double correlation = with_colors && !colors.empty() ? colorCorrelation(colors) : 1.0;
  return {shape + 1.0 - correlation, correlation, colors.size()};
}

Fit fitOfBoth(const RegistrationSide& moving, const RegistrationSide& fixed, double scale,
              const Eigen::Isometry3d& T, bool with_colors) {
  const Fit there = fit(moving, fixed, scale, T, with_colors),
            back = fit(fixed, moving, scale, T.inverse(), with_colors);
  return {0.5 * (there.misfit + back.misfit), 0.5 * (there.correlation + back.correlation),
          std::min(there.pairs, back.pairs)};
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
  Fit fit;
};

bool fitsBetter(const Candidate& a, const Candidate& b) { return a.fit.misfit < b.fit.misfit; }

/// Whether the body stands on another part of it than in the fixed recording.
bool isTurnedOver(const RegistrationSide& moving, const RegistrationSide& fixed,
                  const Eigen::Isometry3d& pose) {
  if (!moving.table() || !fixed.table()) return true;
  return (pose.linear() * moving.table()->normal()).dot(fixed.table()->normal()) < kTurned_cos;
}

/// The starts that fit best, each as well as it can.
std::vector<Candidate> candidatesOf(const RegisteredSurface& moving, const RegisteredSurface& fixed) {
  const RegistrationSide few_moving(moving, kCoarse), few_fixed(fixed, kCoarse);
  const double size = few_fixed.diagonal();
  std::vector<Candidate> candidates;
  for (Eigen::Isometry3d pose : starts(few_moving, few_fixed)) {
    for (int i = 0; i < kCoarseSteps; ++i) improve(few_moving, few_fixed, kCoarseScale * size, &pose);
    candidates.push_back({pose, fitOfBoth(few_moving, few_fixed, kCoarseScale * size, pose, false)});
  }
  candidates.erase(
      std::remove_if(candidates.begin(), candidates.end(),
                     [&](const Candidate& c) { return !isTurnedOver(few_moving, few_fixed, c.pose); }),
      candidates.end());
  std::stable_sort(candidates.begin(), candidates.end(), fitsBetter);
  candidates.resize(std::min(candidates.size(), kKept));
  const RegistrationSide more_moving(moving, 5 * kCoarse), more_fixed(fixed, 5 * kCoarse);
  for (Candidate& candidate : candidates) {
    refine(few_moving, few_fixed, &candidate.pose);
    candidate.fit = fitOfBoth(more_moving, more_fixed, 5.0 * kFineScale * size, candidate.pose, true);
  }
  std::stable_sort(candidates.begin(), candidates.end(), fitsBetter);
  return candidates;
}

/// Compares the best answer, the first one, with those that are turned by more than 20 degrees against it.
void compareAnswers(const std::vector<Candidate>& candidates, Registration* found) {
  const Candidate& best = candidates.front();
  double correlation = kChanceSigmas / std::sqrt(std::max<double>(1.0, static_cast<double>(best.fit.pairs)));
  for (const Candidate& other : candidates) {
    const Eigen::AngleAxisd turn(best.pose.linear().transpose() * other.pose.linear());
    if (turn.angle() <= kOther_rad) continue;
    found->runner_up = std::min(found->runner_up, other.fit.misfit);
    correlation = std::max(correlation, other.fit.correlation);
  }
  found->ambiguous =
      found->runner_up < kClearly * found->misfit && best.fit.correlation < kClearly * correlation;
}

}  // namespace

Registration registerSurfaces(const RegisteredSurface& moving, const RegisteredSurface& fixed) {
  const RegistrationSide many_moving(moving, kFine), many_fixed(fixed, kFine);
  const double a = many_moving.diagonal(), b = many_fixed.diagonal();
  if (a > kOtherSize * b || b > kOtherSize * a)
    throw std::invalid_argument(fmt::format(
        "one surface is {:.4g} m large and the other {:.4g} m: they are not the same body", a, b));
  const std::vector<Candidate> candidates = candidatesOf(moving, fixed);
  if (candidates.empty()) throw std::invalid_argument("the object was not turned over");
  Registration found{candidates.front().pose, candidates.front().fit.misfit, 2.0, false, 0.0};
  compareAnswers(candidates, &found);
  refine(many_moving, many_fixed, &found.T_fixed_moving);
  found.distance_m = typicalDistance(many_moving, many_fixed, found.T_fixed_moving);
  return found;
}

}  // namespace softbody::scanning
