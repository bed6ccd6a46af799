#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <vector>

#include "prediction/association.h"
#include "registration/registration.h"
#include "softbody_common/rasterizer.h"
#include "softbody_tracking/rgbd_frame.h"

namespace softbody {

/// Mean cost a pixel above which depth alone, without a rough pose, makes no pose plausible.
constexpr double kWorstCost = 0.22;

/// Depth of every k-th pixel, with the camera that belongs to it; k so that about so many columns remain.
RgbdFrame subsampled(const RgbdFrame& frame, int columns);

/// Searches poses of one mesh in one frame. Frame and mesh must outlive it.
class PoseSearch {
 public:
  PoseSearch(const RgbdFrame& frame, const TriangleMesh& mesh, double distance_scale_m);

  /// See poseCost().
  double cost(const Eigen::Isometry3d& pose);

  /// How much the depth speaks for a pose: what its pixels cost less, all together, than the worst pose that
  /// is taken, 0 for a worse one. A few pixels far off resemble any body.
  double support(const Eigen::Isometry3d& pose);

  /// The cost, and a little for the turn and the distance from a preferred pose.
  double rankedCost(const Eigen::Isometry3d& pose);

  /// Of poses that depth does not tell apart, as those of a torus turned about its axis, refine() takes from
  /// now on the one that is nearer to this.
  void prefer(const Eigen::Isometry3d& pose) { preferred_ = pose; }

  /// Turns by the vector [rad] about the body's centre, then shifts [m].
  Eigen::Isometry3d moved(const Eigen::Isometry3d& pose, const Eigen::Vector3d& turn,
                          const Eigen::Vector3d& shift) const;

  /// Projective point-to-plane ICP with a gate that narrows from 4 to 1 distance scales.
  Eigen::Isometry3d icp(Eigen::Isometry3d pose, int iterations);

  /// Pattern search along shifts and turns about the body's principal axes, one of which a symmetric body may
  /// turn about freely: about any others it would get stuck in that valley. Steps are halved until they are
  /// below the depth's own precision.
  /// @return with rankedCost() for its cost.
  RegistrationResult refine(const Eigen::Isometry3d& start, double turn_step_rad, double shift_step_m);

 private:
  std::vector<Association> associations(const Eigen::Isometry3d& pose, double gate);

  const RgbdFrame& frame_;
  const TriangleMesh& mesh_;
  double scale_;
  Eigen::Vector3d center_;
  Eigen::Matrix3d axes_;  ///< principal axes of its surface
  std::optional<Eigen::Isometry3d> preferred_;
  RasterImage image_;
};

}  // namespace softbody
