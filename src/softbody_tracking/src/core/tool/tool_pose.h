#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "softbody_common/pinhole.h"
#include "softbody_tracking/rgbd_frame.h"
#include "softbody_tracking/tool/tool_tracker.h"

namespace softbody {

/// One of the tool's markers as a frame shows it.
struct MarkerMeasurement {
  const ToolMarker* marker = nullptr;
  Eigen::Matrix<double, 2, 4> corners;        ///< [px], in the order of markerCorners
  std::vector<Eigen::Vector3d> depth_points;  ///< on the print, camera frame [m]
};

/// Depth under the marker, away from its edge; none where the frame has none.
std::vector<Eigen::Vector3d> depthUnder(const Eigen::Matrix<double, 2, 4>& corners, const RgbdFrame& frame);

/// Both poses (tool in the camera frame) in which a single marker looks alike: Infinitesimal Plane-based Pose
/// Estimation (Collins and Bartoli 2014), the one that fits better first.
std::vector<Eigen::Isometry3d> planarPoses(const MarkerMeasurement& measurement, const Pinhole& camera);

/// [px]
double reprojectionRms(const MarkerMeasurement& measurement, const Pinhole& camera,
                       const Eigen::Isometry3d& T_camera_tool);

struct PoseEstimate {
  Eigen::Isometry3d T_camera_tool = Eigen::Isometry3d::Identity();
  PoseCovariance covariance = PoseCovariance::Zero();  ///< inverse normal matrix, times the variance factor
  double cost = 0.0;                                   ///< chi squared
  double variance_factor = 1.0;                        ///< chi squared per degree of freedom, at least 1
};

/// Levenberg-Marquardt over all markers' corners and depths at once, from a start nearby. Depths count by
/// their distance from the marker's plane, with Cauchy weights.
PoseEstimate refinePose(const std::vector<const MarkerMeasurement*>& measurements, const Pinhole& camera,
                        const Eigen::Isometry3d& start, const ToolTrackerConfig& config);

/// Mean of measured minus computed depth over all points [m]; 0 where there are none.
double depthOffset(const std::vector<const MarkerMeasurement*>& measurements,
                   const Eigen::Isometry3d& T_camera_tool);

}  // namespace softbody
