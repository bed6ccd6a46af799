#include "constraints/pin_conflict.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "softbody_common/geometry/rigid_motion.h"
#include "softbody_common/geometry/tet_geometry.h"

namespace softbody {
namespace {

/// A small rigid motion: turn times the region's radius, then shift, both in metres.
using Motion = Eigen::Matrix<double, 6, 1>;
using MotionMatrix = Eigen::Matrix<double, 3, 6>;

/// Place and size of the region that the pins hold.
struct PinnedRegion {
  explicit PinnedRegion(const std::vector<Pin>& pins) {
    const auto count = static_cast<double>(pins.size());
    for (const Pin& pin : pins) center += pin.position / count;
    double squares = 0.0;
    for (const Pin& pin : pins) squares += (pin.position - center).squaredNorm() / count;
    if (squares > 0.0) radius_m = std::sqrt(squares);
  }

  /// Displacement of a place = matrix * motion.
  MotionMatrix motionAt(const Eigen::Vector3d& place) const {
    return motionJacobian((place - center) / radius_m);
  }

  Eigen::Vector3d center = Eigen::Vector3d::Zero();
  double radius_m = 1.0;
};

/// What the pins of a target's tet say about the target's point.
struct PinnedPoint {
  double share = 0.0;                              ///< of the point's weights that is pinned
  Eigen::Vector3d pull = Eigen::Vector3d::Zero();  ///< from the vertices to their pins, mean [m]
};

PinnedPoint pinnedPoint(const MaterialPoint& place, const Tets& tets, const Points& vertices,
                        const std::vector<Pin>& pins) {
  PinnedPoint point;
  for (int k = 0; k < 4; ++k) {
    const int vertex = tets(place.tet, k);
    const auto pin =
        std::lower_bound(pins.begin(), pins.end(), vertex, [](const Pin& p, int v) { return p.vertex < v; });
    if (pin == pins.end() || pin->vertex != vertex || place.barycentric[k] <= 0.0) continue;
    point.share += place.barycentric[k];
    point.pull += place.barycentric[k] * (pin->position - Eigen::Vector3d(vertices.row(vertex)));
  }
  if (point.share > 0.0) point.pull /= point.share;
  return point;
}

}  // namespace

double pinConflict(const std::vector<Target>& targets, const Tets& tets, const Points& vertices,
                   const std::vector<Pin>& pins) {
  if (pins.empty()) return 0.0;
  constexpr double kAgreement = 0.25;  // weight of a prior of no conflict: a quarter of a target
  const PinnedRegion region(pins);
  Eigen::Matrix<double, 6, 6> weights = kAgreement * Eigen::Matrix<double, 6, 6>::Identity();
  Motion sum = Motion::Zero();
  for (const Target& target : targets) {
    const PinnedPoint pinned = pinnedPoint(target.place, tets, vertices, pins);
    if (pinned.share <= 0.0) continue;
    const Eigen::Vector3d point = positionOf(target.place, vertices, tets);
    const Eigen::Vector3d offset = target.position - point - pinned.pull;
    const MotionMatrix motion = region.motionAt(point + pinned.pull);
    const Eigen::Matrix3d seen =
        target.normal.isZero(0.0)
            ? Eigen::Matrix3d(Eigen::Matrix3d::Identity())
            : Eigen::Matrix3d(target.normal.normalized() * target.normal.normalized().transpose());
    weights += target.weight * pinned.share * motion.transpose() * seen * motion;
    sum += target.weight * pinned.share * motion.transpose() * seen * offset;
  }
  const Motion conflict = weights.ldlt().solve(sum);
  double squares = 0.0;
  for (const Pin& pin : pins) squares += (region.motionAt(pin.position) * conflict).squaredNorm();
  return std::sqrt(squares / static_cast<double>(pins.size()));
}

}  // namespace softbody
