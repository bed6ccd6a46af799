#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <optional>

namespace softbody {

/// Poses that differ by more are different: angle [rad], and distance of their centres [diameters of the
/// body].
constexpr double kOtherTurn = 0.35, kOtherPlace = 0.2;

/// A pose of the undeformed body that a search considers.
struct PoseHypothesis {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();  ///< rest frame in the camera frame
  double cost = 1.0;                                       ///< see PoseCost; 0 is perfect
};

/// The pose that a search accepts.
struct FoundPose {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();  ///< rest frame in the camera frame
  int alike = 1;  ///< poses in the same place that explain the frame equally well, including this one
};

/// Why the poses of a search for a body with a picture were not taken.
struct RefusedPoses {
  std::size_t tried = 0;       ///< 0: the body has no picture, or is found
  std::size_t by_depth = 0;    ///< depth disagrees, or does not confine them
  std::size_t by_picture = 0;  ///< something else than the picture is seen
  bool several = false;        ///< the picture is seen in several places
};

/// What a search found, and the best pose that it tried.
struct SearchOutcome {
  std::optional<FoundPose> found;      ///< empty: no pose is acceptable
  std::optional<PoseHypothesis> best;  ///< with its PoseCost; empty: there was nothing to try
  RefusedPoses refused = {};
};

}  // namespace softbody
