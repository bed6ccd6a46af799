#include "dynamics/target_validation.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "softbody_common/geometry/plausibility.h"
#include "softbody_common/geometry/tet_geometry.h"

namespace softbody {
namespace {

/// A target farther outside of its tet gives no information about the tet. Its squared coordinates in the
/// metric would also exceed the body's own stiffness.
constexpr double kLargestBarycentric = 100.0;

void requireUsable(const Target& target, std::size_t index, Eigen::Index tet_count, double largest_weight) {
  if (target.place.tet < 0 || target.place.tet >= tet_count) {
    throw std::invalid_argument(
        fmt::format("targets[{}] names tet {}; the volume has {} tets", index, target.place.tet, tet_count));
  }
  const bool finite = target.place.barycentric.allFinite() && target.position.allFinite() &&
                      target.normal.allFinite() && std::isfinite(target.weight);
  if (!finite) throw std::invalid_argument(fmt::format("targets[{}] is not finite", index));
  if (target.weight <= 0.0 || target.weight > largest_weight) {
    throw std::invalid_argument(fmt::format("targets[{}] has weight {}; allowed: above 0, up to {}", index,
                                            target.weight, largest_weight));
  }
  if (target.place.barycentric.cwiseAbs().maxCoeff() > kLargestBarycentric) {
    throw std::invalid_argument(fmt::format("targets[{}] has a barycentric coordinate outside of [-{}, {}]",
                                            index, kLargestBarycentric, kLargestBarycentric));
  }
}

/// Of a target from its material point [m].
double distanceOf(const Target& target, const Points& vertices, const Tets& tets) {
  return (target.position - positionOf(target.place, vertices, tets)).norm();
}

}  // namespace

void requireUsable(const TargetSet& targets, const TetTopology& topology, double largest_weight) {
  if (targets.revision != topology.revision) {
    throw std::invalid_argument(fmt::format("targets are for revision {} of the volume, which is at {}",
                                            targets.revision, topology.revision));
  }
  if (targets.reset && !targets.body_pose.matrix().allFinite())
    throw std::invalid_argument("body_pose is not finite");
  for (std::size_t i = 0; i < targets.targets.size(); ++i)
    requireUsable(targets.targets[i], i, topology.tets.rows(), largest_weight);
}

bool hasLeft(const TargetSet& targets, const TetTopology& topology, const Points& vertices) {
  if (targets.targets.empty() || vertices.rows() == 0) return false;
  const double reach = reachOf(topology.rest_vertices);
  return std::none_of(targets.targets.begin(), targets.targets.end(), [&](const Target& target) {
    return distanceOf(target, vertices, topology.tets) <= reach;
  });
}

void requireWithinReach(const TargetSet& targets, const TetTopology& topology, const Points& vertices) {
  const double reach = reachOf(topology.rest_vertices);
  const Eigen::Isometry3d T_body_frame = targets.body_pose.inverse();
  for (std::size_t i = 0; i < targets.targets.size(); ++i) {
    const Target& target = targets.targets[i];
    if (vertices.rows() > 0 && distanceOf(target, vertices, topology.tets) <= reach) continue;
    const Eigen::Vector3d rest = positionOf(target.place, topology.rest_vertices, topology.tets);
    const double distance = (T_body_frame * target.position - rest).norm();
    if (distance <= reach) continue;
    throw std::invalid_argument(fmt::format(
        "targets[{}] is {:.3g} m from its place at body_pose, and not near the body either; allowed: "
        "up to {:.3g} m, ten times the body's size",
        i, distance, reach));
  }
}

}  // namespace softbody
