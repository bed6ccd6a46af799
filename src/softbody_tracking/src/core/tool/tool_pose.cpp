#include "tool/tool_pose.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <opencv2/calib3d.hpp>
#include <opencv2/core/eigen.hpp>

#include "tool/pose_motion.h"

namespace softbody {
namespace {

using Vector6 = Eigen::Matrix<double, 6, 1>;
using Matrix6 = Eigen::Matrix<double, 6, 6>;

constexpr int kDepthGrid = 12;  // depth points in each direction of a marker; its depths err together anyway
constexpr double kDepthMargin = 0.06;  // of a marker's side; depth at its edge may be that of the background
constexpr double kCauchyScale = 3.0;   // standard deviations; larger depth residuals are outliers
constexpr int kMaxIterations = 30;     // of Levenberg-Marquardt
constexpr double kMinZ_m = 1e-3;       // [m] smallest depth of a corner that can be projected

Eigen::Matrix3d cross(const Eigen::Vector3d& v) {
  Eigen::Matrix3d m;
  m << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  return m;
}

/// Gauss-Newton matrix A, half of the gradient b, and the cost.
struct NormalEquations {
  Matrix6 A = Matrix6::Zero();
  Vector6 b = Vector6::Zero();
  double cost = 0.0;
  Matrix6 corner_A = Matrix6::Zero();  ///< the corners' part of A
  double corner_cost = 0.0;            ///< and of the cost

  void add(const Vector6& derivative, double residual, double weight) {
    A.noalias() += weight * derivative * derivative.transpose();
    b.noalias() += weight * residual * derivative;
  }
};

void addCorners(const MarkerMeasurement& measurement, const Pinhole& camera, const Eigen::Isometry3d& T,
                const ToolTrackerConfig& config, NormalEquations* equations) {
  const Eigen::Matrix<double, 3, 4> corners = markerCorners(*measurement.marker);
  const double weight = 1.0 / (config.corner_std_px * config.corner_std_px);
  for (int k = 0; k < 4; ++k) {
    const Eigen::Vector3d turned = T.linear() * corners.col(k), p = turned + T.translation();
    const Eigen::Vector2d residual = camera.project(p) - measurement.corners.col(k);
    const Eigen::Matrix<double, 2, 6> J = pixelByPose(camera, turned, p);
    for (int i = 0; i < 2; ++i) equations->add(J.row(i).transpose(), residual(i), weight);
    equations->cost += weight * residual.squaredNorm();
  }
}

/// Weight of one depth point: the errors of a marker's depth points are correlated.
double depthWeight(const MarkerMeasurement& measurement, const ToolTrackerConfig& config) {
  const auto count = static_cast<double>(measurement.depth_points.size());
  return std::min(1.0, config.depth_independent_samples / std::max(1.0, count));
}

void addDepths(const MarkerMeasurement& measurement, const Eigen::Isometry3d& T,
               const ToolTrackerConfig& config, NormalEquations* equations) {
  const double share = depthWeight(measurement, config);
  const Eigen::Isometry3d& T_tool_marker = measurement.marker->T_tool_marker;
  const Eigen::Vector3d normal = T.linear() * T_tool_marker.linear().col(2);
  const Eigen::Vector3d centre = T * T_tool_marker.translation();
  for (const Eigen::Vector3d& q : measurement.depth_points) {
    const double residual = normal.dot(q - centre);
    const double std_m = config.depth_std_1_m * q.z() * q.z() * std::abs(normal.dot(q / q.z())) + 1e-6;
    const double scaled = residual / (kCauchyScale * std_m);
    const double weight = share / (std_m * std_m * (1.0 + scaled * scaled));
    Vector6 derivative;
    derivative << -normal, normal.cross(q - T.translation());
    equations->add(derivative, residual, weight);
    equations->cost += share * kCauchyScale * kCauchyScale * std::log1p(scaled * scaled);
  }
}

NormalEquations normalEquations(const std::vector<const MarkerMeasurement*>& measurements,
                                const Pinhole& camera, const Eigen::Isometry3d& T,
                                const ToolTrackerConfig& config) {
  NormalEquations equations;
  for (const MarkerMeasurement* measurement : measurements)
    addCorners(*measurement, camera, T, config, &equations);
  equations.corner_A = equations.A;
  equations.corner_cost = equations.cost;
  if (!config.use_depth) return equations;
  for (const MarkerMeasurement* measurement : measurements) addDepths(*measurement, T, config, &equations);
  return equations;
}

double degreesOfFreedom(const std::vector<const MarkerMeasurement*>& measurements,
                        const ToolTrackerConfig& config) {
  double count = -6.0;
  for (const MarkerMeasurement* measurement : measurements) {
    count += 8.0;
    if (config.use_depth)
      count += depthWeight(*measurement, config) * static_cast<double>(measurement->depth_points.size());
  }
  return count;
}

bool inFront(const std::vector<const MarkerMeasurement*>& measurements, const Eigen::Isometry3d& T) {
  return std::all_of(measurements.begin(), measurements.end(), [&T](const MarkerMeasurement* m) {
    return (T * markerCorners(*m->marker)).row(2).minCoeff() > kMinZ_m;
  });
}

}  // namespace

std::vector<Eigen::Vector3d> depthUnder(const Eigen::Matrix<double, 2, 4>& corners, const RgbdFrame& frame) {
  std::vector<Eigen::Vector3d> points;
  if (frame.depth.empty()) return points;
  for (int i = 0; i < kDepthGrid * kDepthGrid; ++i) {
    const auto along = [](int k) {
      return kDepthMargin + (1.0 - 2.0 * kDepthMargin) * k / (kDepthGrid - 1.0);
    };
    const double s = along(i % kDepthGrid), t = along(i / kDepthGrid);
    const Eigen::Vector2d pixel = (1.0 - t) * ((1.0 - s) * corners.col(0) + s * corners.col(1)) +
                                  t * ((1.0 - s) * corners.col(3) + s * corners.col(2));
    const int u = static_cast<int>(std::lround(pixel.x())), v = static_cast<int>(std::lround(pixel.y()));
    if (u < 0 || v < 0 || u >= frame.depth.cols || v >= frame.depth.rows) continue;
    const float z = frame.depth(v, u);
    if (z > 0.0f) points.push_back(frame.camera.unproject(u, v, static_cast<double>(z)));
  }
  return points;
}

std::vector<Eigen::Isometry3d> planarPoses(const MarkerMeasurement& measurement, const Pinhole& camera) {
  const auto h = static_cast<float>(0.5 * measurement.marker->size_m);
  const std::vector<cv::Point3f> square{{-h, h, 0}, {h, h, 0}, {h, -h, 0}, {-h, -h, 0}};
  std::vector<cv::Point2f> pixels;
  pixels.reserve(4);
  for (int k = 0; k < 4; ++k)
    pixels.emplace_back(static_cast<float>(measurement.corners(0, k)),
                        static_cast<float>(measurement.corners(1, k)));
  const cv::Matx33d K(camera.fx, 0, camera.cx, 0, camera.fy, camera.cy, 0, 0, 1);
  std::vector<cv::Mat> rotations, translations;
  cv::solvePnPGeneric(square, pixels, K, cv::noArray(), rotations, translations, false,
                      cv::SOLVEPNP_IPPE_SQUARE);
  std::vector<Eigen::Isometry3d> poses;
  for (std::size_t i = 0; i < rotations.size(); ++i) {
    cv::Mat R;
    cv::Rodrigues(rotations[i], R);
    Eigen::Matrix3d rotation;
    Eigen::Vector3d translation;
    cv::cv2eigen(R, rotation);
    cv::cv2eigen(translations[i], translation);
    if (!rotation.allFinite() || !translation.allFinite()) continue;
    Eigen::Isometry3d T_camera_marker = Eigen::Isometry3d::Identity();
    T_camera_marker.linear() = rotation;
    T_camera_marker.translation() = translation;
    poses.push_back(T_camera_marker * measurement.marker->T_tool_marker.inverse());
  }
  return poses;
}

double reprojectionRms(const MarkerMeasurement& measurement, const Pinhole& camera,
                       const Eigen::Isometry3d& T_camera_tool) {
  const Eigen::Matrix<double, 3, 4> corners = T_camera_tool * markerCorners(*measurement.marker);
  double sum = 0.0;
  for (int k = 0; k < 4; ++k) {
    if (!(corners(2, k) > kMinZ_m)) return INFINITY;
    sum += (camera.project(corners.col(k)) - measurement.corners.col(k)).squaredNorm();
  }
  return std::sqrt(sum / 4.0);
}

Eigen::Matrix<double, 2, 6> pixelByPose(const Pinhole& camera, const Eigen::Vector3d& turned,
                                        const Eigen::Vector3d& p) {
  Eigen::Matrix<double, 2, 3> projection;
  projection << camera.fx / p.z(), 0.0, -camera.fx * p.x() / (p.z() * p.z()), 0.0, camera.fy / p.z(),
      -camera.fy * p.y() / (p.z() * p.z());
  Eigen::Matrix<double, 2, 6> J;
  J << projection, -projection * cross(turned);
  return J;
}

PoseEstimate refinePose(const std::vector<const MarkerMeasurement*>& measurements, const Pinhole& camera,
                        const Eigen::Isometry3d& start, const ToolTrackerConfig& config) {
  Eigen::Isometry3d T = start;
  NormalEquations equations = normalEquations(measurements, camera, T, config);
  double damping = 1e-4;
  for (int i = 0; i < kMaxIterations; ++i) {
    Matrix6 damped = equations.A;
    damped.diagonal() *= 1.0 + damping;
    const Vector6 step = -damped.ldlt().solve(equations.b);
    const Eigen::Isometry3d moved = movedPose(T, step);
    const bool usable = step.allFinite() && inFront(measurements, moved);
    const NormalEquations next =
        usable ? normalEquations(measurements, camera, moved, config) : NormalEquations();
    if (usable && next.cost <= equations.cost) {
      const bool converged = equations.cost - next.cost <= 1e-6 * equations.cost + 1e-12;
      T = moved;
      equations = next;
      damping = std::max(1e-9, 0.1 * damping);
      if (converged) break;
    } else {
      damping *= 10.0;
      if (damping > 1e9) break;
    }
  }
  PoseEstimate estimate;
  estimate.T_camera_tool = T;
  estimate.covariance = equations.A.ldlt().solve(Matrix6::Identity());
  estimate.cost = equations.cost;
  estimate.freedom = degreesOfFreedom(measurements, config);
  estimate.corner_cost = equations.corner_cost;
  estimate.corner_freedom =
      8.0 * static_cast<double>(measurements.size()) - (estimate.covariance * equations.corner_A).trace();
  return estimate;
}

double depthOffset(const std::vector<const MarkerMeasurement*>& measurements, const Eigen::Isometry3d& T) {
  double sum = 0.0;
  std::size_t count = 0;
  for (const MarkerMeasurement* measurement : measurements) {
    const Eigen::Isometry3d T_camera_marker = T * measurement->marker->T_tool_marker;
    const Eigen::Vector3d normal = T_camera_marker.linear().col(2);
    for (const Eigen::Vector3d& q : measurement->depth_points) {
      sum += q.z() - q.z() * normal.dot(T_camera_marker.translation()) / normal.dot(q);
      ++count;
    }
  }
  return count > 0 ? sum / static_cast<double>(count) : 0.0;
}

}  // namespace softbody
