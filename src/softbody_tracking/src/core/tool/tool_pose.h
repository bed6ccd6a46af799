#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "softbody_common/geometry/pinhole.h"
#include "softbody_tracking/rgbd_frame.h"
#include "softbody_tracking/tool/tool_tracker.h"

namespace softbody {

/// One of the tool's markers, measured in a frame.
struct MarkerMeasurement {
  const ToolMarker* marker = nullptr;
  Eigen::Matrix<double, 2, 4> corners;        ///< [px], in the order of markerCorners
  std::vector<Eigen::Vector3d> depth_points;  ///< points on the print, camera frame [m]
};

/// Points on the marker from the frame's depth, away from its edge; empty without depth.
std::vector<Eigen::Vector3d> depthUnder(const Eigen::Matrix<double, 2, 4>& corners, const RgbdFrame& frame);

/// Both poses T_camera_tool that explain a single planar marker, by Infinitesimal Plane-based Pose Estimation
/// (Collins and Bartoli 2014). The better fit comes first.
std::vector<Eigen::Isometry3d> planarPoses(const MarkerMeasurement& measurement, const Pinhole& camera);

/// Root mean square distance between projected and measured corners [px]; infinity behind the camera.
double reprojectionRms(const MarkerMeasurement& measurement, const Pinhole& camera,
                       const Eigen::Isometry3d& T_camera_tool);

/// Derivative of a point's pixel by a move of the pose (movedPose), 2 by 6. @param turned the point from the
/// tool's origin, in the camera's axes [m]. @param p the point in the camera's frame [m].
Eigen::Matrix<double, 2, 6> pixelByPose(const Pinhole& camera, const Eigen::Vector3d& turned,
                                        const Eigen::Vector3d& p);

struct PoseEstimate {
  Eigen::Isometry3d T_camera_tool = Eigen::Isometry3d::Identity();
  PoseCovariance covariance = PoseCovariance::Zero();  ///< inverse normal matrix
  double cost = 0.0;                                   ///< chi squared
  double freedom = 0.0;                                ///< degrees of freedom of the cost
  double corner_cost = 0.0;                            ///< the corners' part of the cost
  double corner_freedom = 0.0;  ///< the corners' coordinates minus the parameters that they determine
};

/// Refines a pose with Levenberg-Marquardt over the corners and depth points of all markers. The residual of
/// a depth point is its distance from the marker's plane, with Cauchy weights.
PoseEstimate refinePose(const std::vector<const MarkerMeasurement*>& measurements, const Pinhole& camera,
                        const Eigen::Isometry3d& start, const ToolTrackerConfig& config);

/// Mean of measured minus computed depth over all depth points [m]; 0 without points.
double depthOffset(const std::vector<const MarkerMeasurement*>& measurements,
                   const Eigen::Isometry3d& T_camera_tool);

}  // namespace softbody
