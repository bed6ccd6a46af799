#include "motion/model_frame.h"

#include <Eigen/Dense>
#include <algorithm>
#include <random>
#include <stdexcept>

namespace softbody::scanning {
namespace {

constexpr int kTrials = 500;       // enough for three points of a plane that holds a fifth of all points
constexpr double kSigmas = 3.0;    // of depth
constexpr double kSmallest = 0.1;  // share of the points that a table holds
constexpr int kPointStep_px = 12;
constexpr std::size_t kFrames = 24;

struct MeasuredPoint {
  Eigen::Vector3d place;  // fixed frame
  double std_m;
};

using Plane = Eigen::Hyperplane<double, 3>;

std::vector<Eigen::Vector3d> eyesOf(const std::vector<KeyFrame>& frames) {
  std::vector<Eigen::Vector3d> eyes;
  for (const KeyFrame& frame : frames) eyes.push_back(frame.T_camera_model.inverse().translation());
  return eyes;
}

std::vector<MeasuredPoint> pointsOf(const std::vector<KeyFrame>& frames, double inverse_depth_std) {
  std::vector<MeasuredPoint> points;
  for (std::size_t i = 0; i < frames.size(); i += std::max<std::size_t>(1, frames.size() / kFrames)) {
    const KeyFrame& frame = frames[i];
    const Eigen::Isometry3d T_fixed_camera = frame.T_camera_model.inverse();
    for (int row = kPointStep_px / 2; row < frame.depth.rows; row += kPointStep_px)
      for (int column = kPointStep_px / 2; column < frame.depth.cols; column += kPointStep_px) {
        const double z = frame.depth(row, column);
        if (z > 0.0)
          points.push_back(
              {T_fixed_camera * frame.camera.unproject(column, row, z), inverse_depth_std * z * z});
      }
  }
  return points;
}

/// The point nearest to all optical axes.
Eigen::Vector3d focusOf(const std::vector<KeyFrame>& frames) {
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  for (const KeyFrame& frame : frames) {
    const Eigen::Isometry3d T_fixed_camera = frame.T_camera_model.inverse();
    const Eigen::Vector3d axis = T_fixed_camera.linear().col(2);
    const Eigen::Matrix3d across = Eigen::Matrix3d::Identity() - axis * axis.transpose();
    sum += across;
    right += across * T_fixed_camera.translation();
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(sum);
  if (solver.eigenvalues()[0] < 0.01 * static_cast<double>(frames.size()))  // all axes within 6 degrees
    throw std::invalid_argument("the camera did not move round the object; walk once round it");
  return sum.ldlt().solve(right);
}

bool holds(const Plane& plane, const MeasuredPoint& point) {
  return plane.absDistance(point.place) < kSigmas * point.std_m;
}

/// Least squares through the points on a plane.
Plane refined(const Plane& plane, const std::vector<MeasuredPoint>& points) {
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  Eigen::Matrix3d squares = Eigen::Matrix3d::Zero();
  double count = 0.0;
  for (const MeasuredPoint& point : points)
    if (holds(plane, point)) mean += point.place, count += 1.0;
  mean /= count;
  for (const MeasuredPoint& point : points)
    if (holds(plane, point)) squares += (point.place - mean) * (point.place - mean).transpose();
  Eigen::Vector3d normal = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(squares).eigenvectors().col(0);
  if (normal.dot(plane.normal()) < 0.0) normal = -normal;
  return {normal, mean};
}

/// The plane with most points that has all cameras on the side of its normal.
Plane findTable(const std::vector<MeasuredPoint>& points, const std::vector<Eigen::Vector3d>& eyes) {
  std::mt19937 random(1);
  std::uniform_int_distribution<std::size_t> any(0, points.size() - 1);
  Plane best;
  std::ptrdiff_t most = 0;
  for (int trial = 0; trial < kTrials; ++trial) {
    const Eigen::Vector3d &a = points[any(random)].place, &b = points[any(random)].place,
                          &c = points[any(random)].place;
    Eigen::Vector3d normal = (b - a).cross(c - a);
    if (!(normal.norm() > 1e-6)) continue;
    normal.normalize();
    if (normal.dot(eyes.front() - a) < 0.0) normal = -normal;
    const Plane plane(normal, a);
    if (std::any_of(eyes.begin(), eyes.end(),
                    [&](const auto& eye) { return plane.signedDistance(eye) < 0.0; }))
      continue;
    const auto on_it =
        std::count_if(points.begin(), points.end(), [&](const auto& p) { return holds(plane, p); });
    if (on_it > most) most = on_it, best = plane;
  }
  if (static_cast<double>(most) < kSmallest * static_cast<double>(points.size()))
    throw std::invalid_argument("no table is seen below the object; put it onto a flat table");
  return refined(refined(best, points), points);
}

}  // namespace

ModelFrame findModelFrame(const std::vector<KeyFrame>& frames, double inverse_depth_std) {
  const std::vector<MeasuredPoint> points = pointsOf(frames, inverse_depth_std);
  const std::vector<Eigen::Vector3d> eyes = eyesOf(frames);
  if (points.size() < 100) throw std::invalid_argument("too little depth was measured");
  const Plane table = findTable(points, eyes);
  const Eigen::Vector3d origin = table.projection(focusOf(frames));
  Eigen::Isometry3d T_fixed_model = Eigen::Isometry3d::Identity();
  const Eigen::Vector3d right = frames.front().T_camera_model.linear().row(0).transpose();
  T_fixed_model.linear().col(2) = table.normal();
  T_fixed_model.linear().col(1) = table.normal().cross(right).normalized();
  T_fixed_model.linear().col(0) = T_fixed_model.linear().col(1).cross(table.normal());
  T_fixed_model.translation() = origin;
  ModelFrame frame;
  frame.T_model_fixed = T_fixed_model.inverse();
  double distance = 0.0;
  for (const Eigen::Vector3d& eye : eyes)
    distance += (eye - origin).norm() / static_cast<double>(eyes.size());
  frame.region = {Eigen::Vector3d(-0.5 * distance, -0.5 * distance, -0.01),
                  Eigen::Vector3d(0.5 * distance, 0.5 * distance, distance)};
  return frame;
}

}  // namespace softbody::scanning
