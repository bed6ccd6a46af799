#pragma once

#include <vector>

#include "markerless/feature_tracks.h"
#include "markerless/small_motion.h"

namespace softbody::scanning {

/// A point of one frame and the plane it lies on in another.
struct PlanePair {
  Eigen::Vector3d point;  ///< frame of the point's camera [m]
  Eigen::Vector3d plane;  ///< N with N . p = 1, the other camera's frame [1/m]
};

/// Pairs points of `to`'s depth with the planes of `from` where they project to.
std::vector<PlanePair> pairPlanes(const TrackedFrame& from, const TrackedFrame& to,
                                  const Eigen::Isometry3d& T_to_from, double inverse_depth_std);

/// Where one frame was taken relative to another.
struct RelativePose {
  Eigen::Isometry3d T_to_from = Eigen::Isometry3d::Identity();
  PoseCovariance covariance = PoseCovariance::Zero();  ///< of the small motion in the camera frame `to`
  double pixel_std = 1.0;                              ///< of the sightings, measured [px]
  double plane_share = 0.0;                            ///< of the paired points that fit, 0..1
  double pair_share = 0.0;                             ///< of the points that have a pair, 0..1
  int sightings = 0;                                   ///< that fit
  std::vector<Sighting> used;                          ///< all of them
};

/// Minimises reprojection and inverse-depth errors of sightings and the distances of points to planes, all in
/// units of their standard deviations, with Cauchy's loss. Tracks anew from each better start.
/// @param from with anchors. @param start expected pose.
RelativePose estimateRelativePose(const TrackedFrame& from, const TrackedFrame& to,
                                  const Eigen::Isometry3d& start, double inverse_depth_std);

}  // namespace softbody::scanning
