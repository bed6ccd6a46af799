#include "markerless/relative_pose.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "softbody_common/statistics/median.h"
#include "softbody_common/statistics/robust.h"

namespace softbody::scanning {
namespace {

constexpr int kStep_px = 14;  // beyond the correlation of depth noise
constexpr int kRounds = 3, kIterations = 15;
constexpr double kPairSigmas = 12.0;  // so far a start may be off
constexpr double kFitSigmas = 3.0;
constexpr double kSmallestPixelStd = 0.03;
constexpr double kLargestPixelStd = 1.0;  // tracking is finer: a larger error is of the pose

/// Normal equations of a small motion in the frame `to`.
struct Normal {
  PoseCovariance H = PoseCovariance::Zero();
  Vector6 g = Vector6::Zero();
};

struct Errors {
  Eigen::Vector3d residual;              // pixel and inverse depth
  Eigen::Matrix<double, 3, 6> jacobian;  // by the small motion
  Eigen::Matrix3d covariance;
};

Errors errorsOf(const TrackedFrame& from, const TrackedFrame& to, const RelativePose& pose, const Sighting& s,
                double q_std) {
  const Pinhole& c = to.camera;
  const Eigen::Vector3d ray = from.camera.unproject(s.from.x(), s.from.y(), 1.0);
  const Eigen::Vector3d p = pose.T_to_from * (ray / s.from_inverse_depth);
  Eigen::Matrix3d by_point;
  const double q = 1.0 / p.z();
  by_point << c.fx * q, 0.0, -c.fx * p.x() * q * q, 0.0, c.fy * q, -c.fy * p.y() * q * q, 0.0, 0.0, -q * q;
  Errors e;
  e.residual << c.project(p) - s.to, s.to_inverse_depth > 0.0 ? q - s.to_inverse_depth : 0.0;
  e.jacobian << by_point, -by_point * crossMatrix(p);
  const Eigen::Vector3d by_depth =
      -by_point * (pose.T_to_from.linear() * ray) / (s.from_inverse_depth * s.from_inverse_depth);
  const double pixel_variance = pose.pixel_std * pose.pixel_std;
  const double q_variance = s.to_inverse_depth > 0.0 ? q_std * q_std : 1e6 * q_std * q_std;
  e.covariance = by_depth * by_depth.transpose() * q_std * q_std;
  e.covariance.diagonal() += Eigen::Vector3d(pixel_variance, pixel_variance, q_variance);
  return e;
}

void addSightings(const TrackedFrame& from, const TrackedFrame& to, double q_std, RelativePose* pose,
                  Normal* normal) {
  pose->sightings = 0;
  std::vector<double> sizes;
  for (const Sighting& s : pose->used) {
    const Errors e = errorsOf(from, to, *pose, s, q_std);
    const Eigen::Matrix3d information = e.covariance.inverse();
    const double squared = e.residual.dot(information * e.residual);
    const double weight = cauchyWeighted(1.0, squared / 3.0);
    normal->H += weight * e.jacobian.transpose() * information * e.jacobian;
    normal->g += weight * e.jacobian.transpose() * information * e.residual;
    if (squared < 3.0 * kFitSigmas * kFitSigmas) ++pose->sightings;
    sizes.push_back(e.residual.head<2>().norm());
  }
  if (sizes.size() < 8) return;
  constexpr double kMedianOfRayleigh = 1.177;
  pose->pixel_std = std::clamp(median(&sizes) / kMedianOfRayleigh, kSmallestPixelStd, kLargestPixelStd);
}

void addPlanes(const std::vector<PlanePair>& pairs, double q_std, RelativePose* pose, Normal* normal) {
  const Eigen::Isometry3d T_from_to = pose->T_to_from.inverse();
  int fit = 0;
  for (const PlanePair& pair : pairs) {
    const Eigen::Vector3d p = T_from_to * pair.point;
    const double residual = (pair.plane.dot(p) - 1.0) / p.z(), variance = 2.0 * q_std * q_std;
    const Eigen::Vector3d n = pose->T_to_from.linear() * pair.plane / p.z();
    Vector6 jacobian;
    jacobian << -n, -pair.point.cross(n);
    const double weight = cauchyWeighted(1.0, residual * residual / variance) / variance;
    normal->H += weight * jacobian * jacobian.transpose();
    normal->g += weight * jacobian * residual;
    if (residual * residual < kFitSigmas * kFitSigmas * variance) ++fit;
  }
  pose->plane_share = pairs.empty() ? 0.0 : static_cast<double>(fit) / static_cast<double>(pairs.size());
}

}  // namespace

std::vector<PlanePair> pairPlanes(const TrackedFrame& from, const TrackedFrame& to,
                                  const Eigen::Isometry3d& T_to_from, double inverse_depth_std) {
  std::vector<PlanePair> pairs;
  const Eigen::Isometry3d T_from_to = T_to_from.inverse();
  for (int row = kStep_px / 2; row < to.depth.rows; row += kStep_px)
    for (int column = kStep_px / 2; column < to.depth.cols; column += kStep_px) {
      const double z = to.depth(row, column);
      if (!(z > 0.0)) continue;
      const Eigen::Vector3d point = to.camera.unproject(column, row, z), p = T_from_to * point;
      if (!(p.z() > 0.05)) continue;
      const Eigen::Vector2d pixel = from.camera.project(p);
      if (!from.camera.contains(pixel.x(), pixel.y())) continue;
      const cv::Vec3f& N = from.plane(cvRound(pixel.y()), cvRound(pixel.x()));
      const Eigen::Vector3d plane(N[0], N[1], N[2]);
      if (plane.isZero() || std::abs(plane.dot(p) - 1.0) / p.z() > kPairSigmas * inverse_depth_std) continue;
      pairs.push_back({point, plane});
    }
  return pairs;
}

RelativePose estimateRelativePose(const TrackedFrame& from, const TrackedFrame& to,
                                  const Eigen::Isometry3d& start, double inverse_depth_std) {
  RelativePose pose;
  pose.T_to_from = start;
  const double points = static_cast<double>(to.depth.total()) / (kStep_px * kStep_px);
  for (int round = 0; round < kRounds; ++round) {
    if (round < 2) pose.used = trackAnchors(from, to, pose.T_to_from);
    const auto pairs = pairPlanes(from, to, pose.T_to_from, inverse_depth_std);
    pose.pair_share = static_cast<double>(pairs.size()) / points;
    for (int i = 0; i < kIterations; ++i) {
      Normal normal;
      addSightings(from, to, inverse_depth_std, &pose, &normal);
      addPlanes(pairs, inverse_depth_std, &pose, &normal);
      normal.H.diagonal().array() += 1e-6;  // nothing is seen: the start stays
      const Vector6 step = -normal.H.ldlt().solve(normal.g);
      pose.T_to_from = moved(step, pose.T_to_from);
      pose.covariance = normal.H.inverse();
      if (step.norm() < 1e-7) break;
    }
  }
  return pose;
}

}  // namespace softbody::scanning
