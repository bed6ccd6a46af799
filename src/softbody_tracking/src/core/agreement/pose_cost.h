#pragma once

#include <Eigen/Geometry>
#include <algorithm>

#include "softbody_common/geometry/types.h"
#include "softbody_common/images/rasterizer.h"
#include "softbody_tracking/rgbd_frame.h"

namespace softbody {

/// Poses whose costs differ by at most this explain the depth equally well: noise changes a cost by as much.
constexpr double kAlikeCost = 0.02;

/// A difference of more standard deviations is no noise.
constexpr double kDoubt = 3.0;

/// Cost of a covered pixel that neither supports nor contradicts a pose, 0..1: without depth, or something
/// nearer hides the body.
constexpr double kUnseenCost = 0.3;
/// Cost of a pixel that another object explains, 0..1: it continues the surface just outside the outline, or
/// hides a body that nobody expects there. Below the 1 of free space: no object lets the camera look through
/// a body.
constexpr double kOtherObject = 0.7;

/// Standard deviation of depth at 1 m [m], of usual cameras.
constexpr double kSigmaAtMetre = 0.0025;

/// Standard deviation of a depth [m]: the noise of a stereo camera grows with the square of the distance.
/// Below 1 m the camera's calibration and rounding are left.
inline double depthSigma(double z) { return kSigmaAtMetre * z * std::max(1.0, z); }

/// A pose with a larger cost is refused. Below kUnseenCost, which a pose has of which nothing is seen.
constexpr double kLargestCost = 0.22;

/// Larger differences of depth are free space or occlusion, at up to 1 m [m]: eight times the noise.
constexpr double kDistanceScale_m = 0.02;

/// The distance scale grows beyond 1 m as the noise of depth does.
/// @param scale at up to 1 m [m].
inline double distanceScaleAt(double z, double scale = kDistanceScale_m) {
  return scale * std::max(1.0, depthSigma(z) / kSigmaAtMetre);
}

/// Pixels that a posed mesh covers, counted by what the depth image says there.
struct PoseAgreement {
  int covered = 0;
  int agreeing = 0;           ///< depth differs by less than a distance scale
  int nearer = 0;             ///< something before the mesh
  int farther = 0;            ///< the camera sees through the mesh
  double misfit = 1.0;        ///< mean cost of the pixels that nothing hides
  double difference_m = 0.0;  ///< median of the depth's difference, without sign
  int outline = 0;            ///< pixels just outside that have depth
  double continuing = 0.0;    ///< sum of how well it continues the surface, 0..1 each
};

/// How badly a posed mesh explains a depth image. Frame and mesh must outlive it.
class PoseCost {
 public:
  /// @param hidden_cost of a pixel where something is nearer. @param scale distance scale at up to 1 m [m].
  PoseCost(const RgbdFrame& frame, const TriangleMesh& mesh, double hidden_cost = kUnseenCost,
           double scale = kDistanceScale_m);
  /// A copy renders into an image of its own, so another thread can use it.
  PoseCost(const PoseCost& other);
  PoseCost& operator=(const PoseCost&) = delete;

  /// Mean cost of the covered pixels, from 0 (perfect) to 1, plus a cost of the outline. A pixel costs the
  /// squared depth difference in distance scales, at most 1. A nearer occluder and missing depth cost less
  /// than 1. Each pixel just outside the outline whose depth continues the surface adds to the sum over the
  /// covered pixels.
  double operator()(const Eigen::Isometry3d& pose);

  PoseAgreement agreement(const Eigen::Isometry3d& pose);

  /// How much of the depth supports a pose: (kLargestCost - cost) times the number of covered pixels;
  /// 0 if the cost is higher. It prefers a large match to a few distant pixels, which could be any body.
  double support(const Eigen::Isometry3d& pose);

  /// Renders the mesh. @return valid until the next call of any member.
  const RasterImage& render(const Points& vertices);
  const RasterImage& render(const Eigen::Isometry3d& pose);

 private:
  const RgbdFrame& frame_;
  const TriangleMesh& mesh_;
  double scale_, hidden_cost_;
  Faces faces_;
  RasterImage image_;
};

}  // namespace softbody
