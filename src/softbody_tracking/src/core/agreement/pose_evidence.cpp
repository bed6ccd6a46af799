#include "agreement/pose_evidence.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <vector>

#include "agreement/pose_cost.h"
#include "agreement/subsampled_frame.h"

namespace softbody {
namespace {

// Length of a shift, as a share of the body's diameter; longer than edges are ragged.
constexpr double kShift = 0.1;
// Directions in which the mesh is shifted, over half a turn.
constexpr int kDirections = 4;
// A free body whose cost rises by a smaller share than in other directions is round about this one.
constexpr double kRound = 0.1;

/// Smallest extent along a principal axis [m].
double thinnestSide(const Points& vertices) {
  const Eigen::RowVector3d center = vertices.colwise().mean();
  const Points arms = vertices.rowwise() - center;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(arms.transpose() * arms);
  const Points along = arms * axes.eigenvectors();
  return (along.colwise().maxCoeff() - along.colwise().minCoeff()).minCoeff();
}

/// The frame that would show the posed mesh alone, before nothing.
RgbdFrame standingFree(const RgbdFrame& frame, const TriangleMesh& mesh, const Eigen::Isometry3d& pose) {
  constexpr float kFar = 1e3f;  // [m]
  RgbdFrame alone = frame;
  alone.depth = PoseCost(frame, mesh, 1.0).render(pose).depth.clone();
  alone.depth.setTo(kFar, alone.depth <= 0.0f);
  return alone;
}

/// Small motions of the body in the image, each with its opposite.
std::vector<Eigen::Isometry3d> slides(const TriangleMesh& mesh, const Eigen::Isometry3d& pose) {
  const Eigen::RowVector3d sides = mesh.vertices.colwise().maxCoeff() - mesh.vertices.colwise().minCoeff();
  const Eigen::Vector3d center = pose * mesh.vertices.colwise().mean().transpose().eval();
  const double length = kShift * sides.norm();
  std::vector<Eigen::Isometry3d> motions;
  for (int k = 0; k < kDirections; ++k) {
    const double angle = M_PI * k / kDirections;
    const Eigen::Vector3d shift = length * Eigen::Vector3d(std::cos(angle), std::sin(angle), 0.0);
    for (const double sign : {1.0, -1.0}) motions.emplace_back(Eigen::Translation3d(sign * shift));
  }
  const double turn = 2.0 * kShift;  // an end moves as far
  for (const double sign : {1.0, -1.0})
    motions.emplace_back(Eigen::Translation3d(center) * Eigen::AngleAxisd(sign * turn, center.normalized()) *
                         Eigen::Translation3d(-center));
  return motions;
}

/// By how much the cost rises with each motion.
std::vector<double> rises(const RgbdFrame& frame, const TriangleMesh& mesh, const Eigen::Isometry3d& pose,
                          double scale_m, const std::vector<Eigen::Isometry3d>& motions) {
  PoseCost cost(frame, mesh, scale_m);
  const double here = cost(pose);
  std::vector<double> result;
  for (const Eigen::Isometry3d& motion : motions) result.push_back(cost(motion * pose) - here);
  return result;
}

}  // namespace

Confinement confinementOf(const RgbdFrame& frame, const TriangleMesh& mesh, const Eigen::Isometry3d& pose,
                          double distance_scale_m) {
  const RgbdFrame small = subsampled(frame, kLargeColumns);
  const double scale_m = std::min(distance_scale_m, thinnestSide(mesh.vertices));
  const std::vector<Eigen::Isometry3d> motions = slides(mesh, pose);
  const std::vector<double> measured = rises(small, mesh, pose, scale_m, motions);
  const std::vector<double> ideal = rises(standingFree(small, mesh, pose), mesh, pose, scale_m, motions);
  const double largest = *std::max_element(ideal.begin(), ideal.end());
  if (largest <= 0.0) return {};  // nothing is in view
  Confinement least{1.0, 1.0};
  for (std::size_t i = 0; i < motions.size(); i += 2) {
    const double free = 0.5 * (ideal[i] + ideal[i + 1]);
    if (free < kRound * largest) continue;
    least.both_ways = std::min(least.both_ways, 0.5 * (measured[i] + measured[i + 1]) / free);
    least.each_way = std::min(least.each_way, std::min(measured[i], measured[i + 1]) / free);
  }
  return least;
}

bool isShown(const RgbdFrame& frame, const TriangleMesh& mesh, const Eigen::Isometry3d& pose,
             const RegistrationConfig& config) {
  const PoseAgreement seen =
      PoseCost(subsampled(frame, kLargeColumns), mesh, config.distance_scale_m).agreement(pose);
  return seen.misfit <= config.max_cost &&
         confinementOf(frame, mesh, pose, config.distance_scale_m).both_ways >= kLeastConfinement;
}

}  // namespace softbody
