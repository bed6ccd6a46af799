#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <vector>

#include "agreement/pose_cost.h"
#include "prediction/association.h"
#include "registration/found_pose.h"
#include "registration/rough_pose.h"

namespace softbody {

/// Moves one mesh to a better pose in one frame: by ICP, or by pattern search on PoseCost. ICP may slide
/// along a surface; PoseCost also sees the outline. Frame and mesh must outlive it.
class PoseRefinement {
 public:
  /// @param rough among poses with nearly equal cost, for example those of a torus turned about its axis, the
  /// nearest to this one wins.
  PoseRefinement(const RgbdFrame& frame, const TriangleMesh& mesh, const std::optional<RoughPose>& rough);

  /// PoseCost, plus a penalty for the turn and the distance from the rough pose, in standard deviations.
  double rankedCost(const Eigen::Isometry3d& pose);

  /// PoseCost alone.
  PoseCost& cost() { return cost_; }

  /// Turns a pose about the body's centre, then shifts it. @param turn rotation vector [rad]. @param shift
  /// [m].
  Eigen::Isometry3d moved(const Eigen::Isometry3d& pose, const Eigen::Vector3d& turn,
                          const Eigen::Vector3d& shift) const;

  /// Projective point-to-plane ICP (Besl and McKay 1992; Chen and Medioni 1992). Its gate narrows to one
  /// distance scale.
  Eigen::Isometry3d icp(Eigen::Isometry3d pose, int iterations);

  /// Pattern search along shifts and along turns about the body's principal axes. A symmetric body may turn
  /// freely about one of these; a search about other axes would stop in that valley. The steps are halved
  /// down to a part of a pixel.
  /// @param shift_m first step; a turn moves the body's ends by half as much. @return the cost is
  /// rankedCost().
  PoseHypothesis patternSearch(const Eigen::Isometry3d& start, double shift_m);

  /// Principal axes of the mesh's area in the rest frame, one a column.
  const Eigen::Matrix3d& axes() const { return axes_; }

  /// Size of a pixel at the body [m].
  double pixelAt(const Eigen::Isometry3d& pose) const;
  /// Distance scale at the body [m].
  double scaleAt(const Eigen::Isometry3d& pose) const;

 private:
  std::optional<PoseHypothesis> betterNeighbor(const PoseHypothesis& best, double shift_m, int axis);
  std::vector<Association> associations(const Eigen::Isometry3d& pose, double gate);

  const RgbdFrame& frame_;
  const TriangleMesh& mesh_;
  std::optional<RoughPose> rough_;
  PoseCost cost_;
  double diameter_m_;
  Eigen::Vector3d center_;  ///< of the mesh's area
  Eigen::Matrix3d axes_;    ///< principal axes of the mesh's area, one a column
};

}  // namespace softbody
