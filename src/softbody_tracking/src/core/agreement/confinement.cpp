#include "agreement/confinement.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "agreement/body_edges.h"
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
// Depth of what is behind everything [m].
constexpr float kFar = 1e3f;

/// The frame that would show the posed mesh alone, before nothing, with the gaps of this frame.
RgbdFrame aloneIn(const RgbdFrame& frame, const TriangleMesh& mesh, const Eigen::Isometry3d& pose) {
  RgbdFrame alone = frame;
  alone.depth = PoseCost(frame, mesh).render(pose).depth.clone();
  alone.depth.setTo(kFar, alone.depth <= 0.0f);
  alone.depth.setTo(0.0f, ~(frame.depth > 0.0f));
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

/// By how much the cost rises with each pair of opposite motions.
std::vector<double> rises(const RgbdFrame& frame, const TriangleMesh& mesh, const Eigen::Isometry3d& pose,
                          double scale_m, const std::vector<Eigen::Isometry3d>& motions) {
  PoseCost cost(frame, mesh, kUnseenCost, scale_m);
  const double here = cost(pose);
  std::vector<double> result;
  for (std::size_t i = 0; i < motions.size(); i += 2)
    result.push_back(0.5 * (cost(motions[i] * pose) + cost(motions[i + 1] * pose)) - here);
  return result;
}

}  // namespace

double confinement(const RgbdFrame& frame, const TriangleMesh& mesh, const Eigen::Isometry3d& pose) {
  const RgbdFrame small = subsampled(frame, kLargeColumns);
  const double scale_m = std::min(kDistanceScale_m, thicknessOf(mesh.vertices));
  const std::vector<Eigen::Isometry3d> motions = slides(mesh, pose);
  const std::vector<double> measured = rises(small, mesh, pose, scale_m, motions);
  const RgbdFrame alone = aloneIn(small, mesh, pose);
  // The edges of a gap would confine a body of which nothing is measured.
  if (cv::countNonZero((alone.depth > 0.0f) & (alone.depth < kFar)) == 0) return 0.0;
  const std::vector<double> free = rises(alone, mesh, pose, scale_m, motions);
  const double largest = *std::max_element(free.begin(), free.end());
  if (largest <= 0.0) return 0.0;
  double least = 1.0;
  for (std::size_t i = 0; i < free.size(); ++i)
    if (free[i] >= kRound * largest) least = std::min(least, measured[i] / free[i]);
  return std::max(0.0, least);
}

}  // namespace softbody
