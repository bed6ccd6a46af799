#include "registration/pose_refinement.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "softbody_common/geometry/rigid_fit.h"

namespace softbody {
namespace {

// Smallest step of the pattern search [px]; below it the image decides nothing.
constexpr double kPrecision = 0.1;

struct AreaMoments {
  Eigen::Vector3d center = Eigen::Vector3d::Zero();
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();  ///< about the centre [m^4]
};

/// Moments of the surface, not of the vertices: these may be denser in some places.
AreaMoments areaMoments(const TriangleMesh& mesh) {
  const auto overTriangles = [&](const auto& add) {
    for (const auto& triangle : mesh.triangles.rowwise()) {
      Eigen::Matrix3d corners;
      for (int k = 0; k < 3; ++k) corners.col(k) = mesh.vertices.row(triangle[k]);
      const Eigen::Vector3d a = corners.col(1) - corners.col(0), b = corners.col(2) - corners.col(0);
      add(corners, 0.5 * a.cross(b).norm());
    }
  };
  AreaMoments moments;
  double sum = 0.0;
  overTriangles([&](const Eigen::Matrix3d& corners, double area) {
    moments.center += area * corners.rowwise().mean();
    sum += area;
  });
  if (sum > 0.0) moments.center /= sum;
  overTriangles([&](const Eigen::Matrix3d& corners, double area) {
    const Eigen::Matrix3d arms = corners.colwise() - moments.center;
    const Eigen::Vector3d middle = arms.rowwise().sum();
    moments.spread += area / 12.0 * (arms * arms.transpose() + middle * middle.transpose());
  });
  return moments;
}

}  // namespace

PoseRefinement::PoseRefinement(const RgbdFrame& frame, const TriangleMesh& mesh,
                               const std::optional<RoughPose>& rough)
    : frame_(frame),
      mesh_(mesh),
      rough_(rough),
      cost_(frame, mesh),
      diameter_m_((mesh.vertices.colwise().maxCoeff() - mesh.vertices.colwise().minCoeff()).norm()) {
  const AreaMoments moments = areaMoments(mesh);
  center_ = moments.center;
  axes_ = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(moments.spread).eigenvectors();
}

double PoseRefinement::pixelAt(const Eigen::Isometry3d& pose) const {
  return (pose * center_).norm() / frame_.camera.fx;
}

double PoseRefinement::scaleAt(const Eigen::Isometry3d& pose) const {
  return distanceScaleAt((pose * center_).z());
}

double PoseRefinement::rankedCost(const Eigen::Isometry3d& pose) {
  if (!rough_) return cost_(pose);
  const PoseDeviation off = deviationFrom(*rough_, pose, center_);
  // As the logarithm of the density of rough poses.
  return cost_(pose) + kAlikeCost * (off.turn * off.turn + off.shift * off.shift);
}

Eigen::Isometry3d PoseRefinement::moved(const Eigen::Isometry3d& pose, const Eigen::Vector3d& turn,
                                        const Eigen::Vector3d& shift) const {
  const Eigen::Vector3d center = pose * center_;
  const double angle = turn.norm();
  const Eigen::AngleAxisd rotation(angle,
                                   angle > 0.0 ? Eigen::Vector3d(turn / angle) : Eigen::Vector3d::UnitX());
  return Eigen::Translation3d(center + shift) * rotation * Eigen::Translation3d(-center) * pose;
}

Eigen::Isometry3d PoseRefinement::icp(Eigen::Isometry3d pose, int iterations) {
  const double scale = scaleAt(pose);
  double gate = scale + kOtherPlace * diameter_m_;  // a start in the same place, and the misfit there
  const double narrowing = std::pow(scale / gate, 2.0 / iterations);  // the second half converges
  for (int i = 0; i < iterations; ++i) {
    pose = rigidStep(refsTo(associations(pose, gate))) * pose;
    gate = std::max(scale, narrowing * gate);
  }
  return pose;
}

/// The pose one step forwards or backwards along an axis, if it is better.
/// @param axis 0..2: turn about a principal axis; 3..5: shift.
std::optional<PoseHypothesis> PoseRefinement::betterNeighbor(const PoseHypothesis& best, double shift_m,
                                                             int axis) {
  for (double sign : {1.0, -1.0}) {
    Eigen::Vector3d turn = Eigen::Vector3d::Zero(), shift = Eigen::Vector3d::Zero();
    if (axis < 3)
      turn = sign * shift_m / diameter_m_ * (best.pose.linear() * axes_.col(axis));
    else
      shift = sign * shift_m * (best.pose.linear() * axes_.col(axis - 3));
    const Eigen::Isometry3d pose = moved(best.pose, turn, shift);
    const double cost = rankedCost(pose);
    if (cost < best.cost) return PoseHypothesis{pose, cost};
  }
  return std::nullopt;
}

PoseHypothesis PoseRefinement::patternSearch(const Eigen::Isometry3d& start, double shift_m) {
  PoseHypothesis best{start, rankedCost(start)};
  while (shift_m > kPrecision * pixelAt(best.pose)) {
    bool improved = false;
    for (int axis = 0; axis < 6; ++axis) {
      const auto better = betterNeighbor(best, shift_m, axis);
      if (!better) continue;
      best = *better;
      improved = true;
    }
    if (!improved) shift_m *= 0.5;
  }
  return best;
}

std::vector<Association> PoseRefinement::associations(const Eigen::Isometry3d& pose, double gate) {
  const Points vertices = transformed(mesh_.vertices, pose);
  const RasterImage& image = cost_.render(vertices);
  std::vector<Association> result;
  for (int v = image.region.y; v < image.region.br().y; ++v) {
    for (int u = image.region.x; u < image.region.br().x; ++u) {
      const int f = image.triangle(v, u);
      const float z = frame_.depth(v, u);
      if (f < 0 || !(z > 0.0f) || std::abs(z - image.depth(v, u)) > gate) continue;
      Association a;
      a.predicted = frame_.camera.unproject(u, v, image.depth(v, u));
      a.measured = frame_.camera.unproject(u, v, z);
      const Eigen::Vector3d corner = vertices.row(mesh_.triangles(f, 0));
      a.normal = (vertices.row(mesh_.triangles(f, 1)).transpose() - corner)
                     .cross(vertices.row(mesh_.triangles(f, 2)).transpose() - corner)
                     .normalized();
      if (!a.normal.isZero()) result.push_back(a);
    }
  }
  return result;
}

}  // namespace softbody
