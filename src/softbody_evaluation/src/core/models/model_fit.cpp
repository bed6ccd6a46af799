#include "softbody_evaluation/models/model_fit.h"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>
#include <vector>

#include "softbody_common/geometry/rigid_motion.h"
#include "softbody_common/statistics/median.h"
#include "softbody_evaluation/measures/surface_samples.h"
#include "softbody_sim/surface_mesh/closest_point.h"

namespace softbody::evaluation {
namespace {

constexpr double kOtherSize = 3.0;     // of the diagonals; half of a ball is smaller by 1.2 times
constexpr std::size_t kCoarse = 200;   // samples that tell starts apart
constexpr std::size_t kFine = 5000;    // samples of the final fit
constexpr double kSameTurn = 0.15;     // [rad] between starts that end in one pose
constexpr std::size_t kKept = 12;      // starts that are fitted to the end
constexpr double kCoarseScale = 0.05;  // of the weights, in diagonals: an error of a few degrees
constexpr double kFineScale = 0.002;   // 0.5 mm of a body of 250 mm: about what a good scan is wrong by
constexpr double kSeen = 0.5;          // at least: was measured
constexpr int kCoarseSteps = 12, kFineSteps = 60;  // the fit ends earlier where it stands still

using Vector6 = Eigen::Matrix<double, 6, 1>;
using Matrix6 = Eigen::Matrix<double, 6, 6>;

std::vector<Eigen::Vector3d> seenPlaces(const Model& model, std::size_t count) {
  std::vector<Eigen::Vector3d> places;
  for (const SurfaceSample& sample : sampleSurface(model.mesh, count, 1)) {
    if (model.seen.empty() ||
        interpolated(model.seen, model.mesh.triangles, sample.triangle, sample.weights) >= kSeen)
      places.push_back(sample.position);
  }
  if (places.empty())
    throw std::invalid_argument(fmt::format("{}: no part of the surface was seen", model.name));
  return places;
}

/// A surface and points on it.
struct Sampled {
  Sampled(const Model& model, std::size_t count)
      : mesh(model.mesh), query(mesh.vertices, mesh.triangles), places(seenPlaces(model, count)) {}

  Eigen::Vector3d middle() const {
    const Eigen::Vector3d sum = std::accumulate(places.begin(), places.end(), Eigen::Vector3d(0, 0, 0));
    return sum / static_cast<double>(places.size());
  }

  /// Columns: principal axes, right-handed.
  Eigen::Matrix3d axes() const {
    const Eigen::Vector3d centre = middle();
    Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
    for (const Eigen::Vector3d& p : places) covariance += (p - centre) * (p - centre).transpose();
    Eigen::Matrix3d result = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(covariance).eigenvectors();
    if (result.determinant() < 0.0) result.col(0) *= -1.0;
    return result;
  }

  Eigen::Vector3d normal(int triangle) const {
    const auto t = mesh.triangles.row(triangle);
    const Eigen::Vector3d a = mesh.vertices.row(t[0]), b = mesh.vertices.row(t[1]),
                          c = mesh.vertices.row(t[2]);
    return (b - a).cross(c - a).normalized();
  }

  const TriangleMesh& mesh;
  ClosestPointQuery query;
  std::vector<Eigen::Vector3d> places;
};

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
std::vector<Eigen::Isometry3d> starts(const Sampled& scanned, const Sampled& truth) {
  const Eigen::Matrix3d from = scanned.axes(), to = truth.axes();
  std::vector<Eigen::Isometry3d> poses;
  for (const Eigen::Matrix3d& R : axisRotations()) {
    for (int turned = 0; turned < 4; ++turned) {
      Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
      if (turned > 0) turn = Eigen::AngleAxisd(0.25 * M_PI, Eigen::Vector3d::Unit(turned - 1)).matrix();
      Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
      pose.linear() = to * turn * R * from.transpose();
      pose.translation() = truth.middle() - pose.linear() * scanned.middle();
      poses.push_back(pose);
    }
  }
  return poses;
}

/// One Gauss-Newton step. @param scale distance at which a point loses three quarters of its weight [m].
/// @return about how far it moves a point [m].
double improve(const Sampled& scanned, const Sampled& truth, double scale, Eigen::Isometry3d* pose) {
  const double size = diagonalOf(truth.mesh);
  const Eigen::Vector3d centre = *pose * scanned.middle();
  Matrix6 normal_matrix = Matrix6::Zero();
  Vector6 right_side = Vector6::Zero();
  for (const Eigen::Vector3d& place : scanned.places) {
    const Eigen::Vector3d moved = *pose * place;
    const SurfacePoint nearest = truth.query.closest(moved);
    const Eigen::Vector3d normal = truth.normal(nearest.triangle), offset = moved - nearest.position;
    const double weight = std::pow(1.0 + offset.squaredNorm() / (scale * scale), -2.0);
    Vector6 row;
    row << (moved - centre).cross(normal) / size, normal;  // all entries have one size
    normal_matrix += weight * row * row.transpose();
    right_side -= weight * normal.dot(offset) * row;
  }
  // A ball may turn freely: such a turn stays zero.
  normal_matrix.diagonal().array() += 1e-9 * normal_matrix.trace() + 1e-300;
  const Vector6 step = normal_matrix.ldlt().solve(right_side);
  *pose = rigidMotion(step.head<3>() / size, step.tail<3>(), centre) * *pose;
  return step.norm();
}

/// Median of |offset| [m].
double typicalDistance(const Sampled& scanned, const Sampled& truth, const Eigen::Isometry3d& pose) {
  std::vector<double> distances;
  for (const Eigen::Vector3d& place : scanned.places)
    distances.push_back((pose * place - truth.query.closest(pose * place).position).norm());
  return median(&distances);
}

/// Mean of Geman and McClure's cost in both directions, 0..2.
double misfit(const Sampled& scanned, const Sampled& truth, double scale, const Eigen::Isometry3d& pose) {
  const auto cost = [scale](const Sampled& from, const Sampled& to, const Eigen::Isometry3d& T) {
    double sum = 0.0;
    for (const Eigen::Vector3d& place : from.places) {
      const double d = (T * place - to.query.closest(T * place).position).squaredNorm() / (scale * scale);
      sum += d / (1.0 + d);
    }
    return sum / static_cast<double>(from.places.size());
  };
  return cost(scanned, truth, pose) + cost(truth, scanned, pose.inverse());
}

/// From far to near: the scale falls with the distance that is left.
void refine(const Sampled& scanned, const Sampled& truth, Eigen::Isometry3d* pose) {
  const double size = diagonalOf(truth.mesh);
  for (int i = 0; i < kFineSteps; ++i) {
    const double scale =
        std::clamp(3.0 * typicalDistance(scanned, truth, *pose), kFineScale * size, kCoarseScale * size);
    if (improve(scanned, truth, scale, pose) < 1e-7 * size) return;
  }
}

void requireSimilarSize(const Model& scanned, const Model& truth) {
  const double a = diagonalOf(scanned.mesh), b = diagonalOf(truth.mesh);
  if (a <= kOtherSize * b && b <= kOtherSize * a) return;
  throw std::invalid_argument(
      fmt::format("{} is {:.4g} m large and {} {:.4g} m: they are not the same body, or one of them is not "
                  "in metres; write an object YAML with its unit, and name that",
                  scanned.name, a, truth.name, b));
}

struct Candidate {
  Eigen::Isometry3d pose;
  double misfit;
};

bool fitsBetter(const Candidate& a, const Candidate& b) { return a.misfit < b.misfit; }

/// Many starts end in one pose: only the best of these stays.
std::vector<Candidate> bestOf(std::vector<Candidate> candidates) {
  std::stable_sort(candidates.begin(), candidates.end(), fitsBetter);
  std::vector<Candidate> kept;
  for (const Candidate& candidate : candidates) {
    const bool known = std::any_of(kept.begin(), kept.end(), [&](const Candidate& other) {
      return Eigen::AngleAxisd(other.pose.linear().transpose() * candidate.pose.linear()).angle() < kSameTurn;
    });
    if (!known) kept.push_back(candidate);
    if (kept.size() == kKept) break;
  }
  return kept;
}

}  // namespace

Eigen::Isometry3d fitModel(const Model& scanned, const Model& truth) {
  requireSimilarSize(scanned, truth);
  const double size = diagonalOf(truth.mesh);
  const Sampled few_scanned(scanned, kCoarse), few_true(truth, kCoarse);
  std::vector<Candidate> candidates;
  for (Eigen::Isometry3d pose : starts(Sampled(scanned, kFine), Sampled(truth, kFine))) {
    for (int i = 0; i < kCoarseSteps; ++i) improve(few_scanned, few_true, kCoarseScale * size, &pose);
    candidates.push_back({pose, misfit(few_scanned, few_true, kCoarseScale * size, pose)});
  }
  candidates = bestOf(std::move(candidates));
  for (Candidate& candidate : candidates) {
    refine(few_scanned, few_true, &candidate.pose);
    candidate.misfit = misfit(few_scanned, few_true, 5.0 * kFineScale * size, candidate.pose);
  }
  Eigen::Isometry3d pose = std::min_element(candidates.begin(), candidates.end(), fitsBetter)->pose;
  refine(Sampled(scanned, kFine), Sampled(truth, kFine), &pose);
  return pose;
}

}  // namespace softbody::evaluation
